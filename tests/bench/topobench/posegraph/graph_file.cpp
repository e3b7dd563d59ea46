// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/posegraph/graph_file.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "core/slam/graph_pattern.hpp"
#include "tests/bench/carmen/fields.hpp"
#include "tests/bench/carmen/passed_over.hpp"
#include "tests/bench/topobench/posegraph/graph_tags.hpp"

namespace topo::bench {
namespace {

using types::Errc;
using types::Result;
using types::Status;

constexpr double kInformationMax = 1e15;  // a micrometre's, a thousandfold

enum class Format { kG2o, kToro };

/// Where row and column of the upper triangle, row by row, stand among a line's six numbers.
using Order = std::array<std::size_t, 6>;
constexpr Order kG2oOrder{0, 1, 2, 3, 4, 5};   // I11 I12 I13 I22 I23 I33
constexpr Order kToroOrder{0, 1, 4, 2, 5, 3};  // I11 I12 I22 I33 I13 I23

/// An edge as the file names its nodes.
struct NamedEdge {
  NodeName from, to;
  slam::Edge edge;
  int line = 0;
};

Eigen::Matrix3d symmetric(const std::array<double, 6>& numbers, const Order& order) {
  Eigen::Matrix3d matrix;
  std::size_t k = 0;
  for (int r = 0; r < 3; ++r) {
    for (int c = r; c < 3; ++c) matrix(r, c) = matrix(c, r) = numbers[order[k++]];
  }
  return matrix;
}

/// The least and the greatest eigenvalue.
std::pair<double, double> eigenvalues_of(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(matrix, Eigen::EigenvaluesOnly);
  return {parts.eigenvalues()[0], parts.eigenvalues()[2]};
}

bool is_information(const Eigen::Matrix3d& matrix) {
  const auto [least, greatest] = eigenvalues_of(matrix);
  return greatest > 0.0 && least >= -1e-9 * greatest;
}

class Reader {
 public:
  explicit Reader(LineSource source) : source_(std::move(source)) {}

  Result<GraphFile> run() {
    auto whole = read_lines(source_, [this](const Fields& f) { return f.is_comment() ? Status{} : take(f); });
    if (!whole) return tl::unexpected(whole.error());
    return finish();
  }

 private:
  Status take(const Fields& f) {
    switch (graph_line_of(f.word(0))) {
      case GraphLine::kVertexG2o:
        return take_vertex(f, Format::kG2o);
      case GraphLine::kVertexToro:
        return take_vertex(f, Format::kToro);
      case GraphLine::kEdgeG2o:
        return take_edge(f, Format::kG2o);
      case GraphLine::kEdgeToro:
        return take_edge(f, Format::kToro);
      case GraphLine::kFix:
        return take_fix(f);
      case GraphLine::kOther:
        return f.bad(
            0, meaning_of(f.word(0)),
            "a graph of relative poses in the plane alone: VERTEX_SE2, EDGE_SE2 and FIX (g2o), VERTEX2 "
            "and EDGE2 (TORO)");
      case GraphLine::kForeign:
        break;
    }
    passed_over_.add(source_.line(), f.word(0));
    return {};
  }

  Status expect_format(const Fields& f, Format format) {
    if (!format_) format_ = format;
    if (*format_ == format) return {};
    return f.bad(
        0, "tag",
        *format_ == Format::kG2o ? "tags of g2o, as the lines before" : "tags of TORO, as the lines before");
  }

  static Result<NodeName> name(const Fields& f, std::size_t word, std::string_view what) {
    auto name = parse_node_name(f.word(word));
    if (!name) return f.bad(word, what, "a whole number or a name");
    return std::move(*name);
  }

  Status take_vertex(const Fields& f, Format format) {
    if (auto s = expect_format(f, format); !s) return s;
    if (auto s = f.expect_count(5, "TAG id x y theta"); !s) return s;
    const auto id = name(f, 1, "id");
    if (!id) return tl::unexpected(id.error());
    const auto pose = f.pose(2, "pose");
    if (!pose) return tl::unexpected(pose.error());
    if (!vertices_.emplace(*id, *pose).second) return f.bad(1, "id", "a node that no line before has given");
    return {};
  }

  Status take_edge(const Fields& f, Format format) {
    constexpr std::size_t kBare = 6;
    const std::string_view layout = format == Format::kG2o ? "TAG from to x y theta I11 I12 I13 I22 I23 I33"
                                                           : "TAG from to x y theta I11 I12 I22 I33 I13 I23";
    if (auto s = expect_format(f, format); !s) return s;
    if (f.count() == kBare)
      return source_.bad("an edge without its information matrix", fmt::format("12 words: {}", layout));
    if (auto s = f.expect_count(12, layout); !s) return s;
    auto from = name(f, 1, "from"), to = name(f, 2, "to");
    if (!from) return tl::unexpected(from.error());
    if (!to) return tl::unexpected(to.error());
    if (*from == *to) return f.bad(2, "to", "another node than the edge comes from");
    const auto pose = f.pose(3, "measured pose");
    if (!pose) return tl::unexpected(pose.error());
    const auto information = read_information(f, format);
    if (!information) return tl::unexpected(information.error());
    edges_.push_back({std::move(*from), std::move(*to), {0, 0, *pose, *information, false}, source_.line()});
    return {};
  }

  Result<Eigen::Matrix3d> read_information(const Fields& f, Format format) {
    std::array<double, 6> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto entry = f.number(6 + i, "information", -kInformationMax, kInformationMax);
      if (!entry) return tl::unexpected(entry.error());
      numbers[i] = *entry;
    }
    const bool g2o = format == Format::kG2o;
    const Eigen::Matrix3d information = symmetric(numbers, g2o ? kG2oOrder : kToroOrder);
    if (is_information(information)) return information;
    const auto [least, greatest] = eigenvalues_of(information);
    const bool other_order = is_information(symmetric(numbers, g2o ? kToroOrder : kG2oOrder));
    return source_.bad(
        fmt::format("an information matrix with eigenvalues {:.3g} to {:.3g}", least, greatest),
        fmt::format("a positive semidefinite one that is not zero{}",
                    !other_order ? ""
                    : g2o
                        ? "; its numbers seem to stand in TORO's order, I11 I12 I22 I33 I13 I23, which goes "
                          "with the tag EDGE2"
                        : "; its numbers seem to stand in g2o's order, I11 I12 I13 I22 I23 I33, which goes "
                          "with the tag EDGE_SE2"));
  }

  Status take_fix(const Fields& f) {
    if (f.count() < 2) return f.expect_count(2, "FIX id, or more ids");
    for (std::size_t i = 1; i < f.count(); ++i) {
      auto id = name(f, i, "id");
      if (!id) return tl::unexpected(id.error());
      fixed_.emplace(std::move(*id), source_.line());
    }
    return {};
  }

  tl::unexpected<types::Error> bad_at(int line, std::string_view found, std::string_view expected) const {
    return types::fail(Errc::kInvalidInput,
                       fmt::format("{}:{}: found {}, expected {}", source_.path(), line, found, expected));
  }

  Result<GraphFile> finish() {
    if (edges_.empty()) return bad_at(source_.line(), "no edge", "lines EDGE_SE2 (g2o) or EDGE2 (TORO)");
    const bool estimated = !vertices_.empty();
    if (!estimated) {
      for (const NamedEdge& named : edges_) {
        vertices_.emplace(named.from, types::Se2{});
        vertices_.emplace(named.to, types::Se2{});
      }
    }
    GraphFile file;
    std::map<NodeName, std::size_t> index;
    for (const auto& [name, pose] : vertices_) {
      index.emplace(name, file.names.size());
      file.names.push_back(name);
      if (estimated) file.poses.push_back(pose);
    }
    if (auto s = number_edges(index, file); !s) return tl::unexpected(s.error());
    if (auto s = number_fixed(index, file); !s) return tl::unexpected(s.error());
    if (!slam::is_connected(file.names.size(), file.edges, file.fixed))
      return bad_at(source_.line(), "nodes without a chain of edges between them", "a graph in one piece");
    if (passed_over_.count() > 0)
      file.remarks.push_back(passed_over_.remark("without a relative pose in the plane"));
    return file;
  }

  Status number_edges(const std::map<NodeName, std::size_t>& index, GraphFile& file) {
    for (NamedEdge& named : edges_) {
      for (const NodeName& name : {named.from, named.to}) {
        if (!index.contains(name)) {
          return bad_at(named.line, fmt::format("an edge to node {}", name.text()),
                        "nodes that have a vertex line");
        }
      }
      named.edge.from = index.at(named.from);
      named.edge.to = index.at(named.to);
      file.edges.push_back(named.edge);
    }
    return {};
  }

  Status number_fixed(const std::map<NodeName, std::size_t>& index, GraphFile& file) const {
    for (const auto& [name, line] : fixed_) {
      const auto found = index.find(name);
      if (found == index.end())
        return bad_at(line, fmt::format("FIX of node {}", name.text()), "a node of the graph");
      file.fixed.push_back(found->second);
    }
    if (file.fixed.size() > 1 && file.poses.empty()) {
      return bad_at(fixed_.begin()->second, fmt::format("{} fixed nodes", file.fixed.size()),
                    "a vertex line for each, which says where it is held");
    }
    return {};
  }

  LineSource source_;
  std::optional<Format> format_;
  std::map<NodeName, types::Se2> vertices_;
  std::vector<NamedEdge> edges_;
  std::map<NodeName, int> fixed_;  ///< and the line that says so
  PassedOver passed_over_;
};

}  // namespace

Result<GraphFile> read_graph(LineSource source) { return Reader(std::move(source)).run(); }

Result<GraphFile> read_graph(const std::string& path) {
  auto source = LineSource::open(path);
  if (!source) return tl::unexpected(source.error());
  return read_graph(std::move(*source));
}

}  // namespace topo::bench
