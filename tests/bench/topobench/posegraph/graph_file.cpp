// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/posegraph/graph_file.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <map>
#include <utility>

#include "core/slam/graph_pattern.hpp"
#include "tests/bench/carmen/fields.hpp"

namespace topo::bench {
namespace {

using types::Errc;
using types::Result;
using types::Status;

constexpr std::size_t kIdMax = std::size_t{1} << 53U;  // what a double counts exactly
constexpr double kInformationMax = 1e15;               // a micrometre's, a thousandfold

enum class Format { kG2o, kToro };

/// Where row and column of the upper triangle, row by row, stand among a line's six numbers.
constexpr std::array<std::size_t, 6> kG2oOrder{0, 1, 2, 3, 4, 5};   // I11 I12 I13 I22 I23 I33
constexpr std::array<std::size_t, 6> kToroOrder{0, 1, 4, 2, 5, 3};  // I11 I12 I22 I33 I13 I23

/// An edge as the file names its nodes.
struct NamedEdge {
  std::uint64_t from = 0, to = 0;
  slam::Edge edge;
  int line = 0;
};

class Reader {
 public:
  explicit Reader(LineSource source) : source_(std::move(source)) {}

  Result<GraphFile> run() {
    std::vector<std::string_view> words;
    while (true) {
      const auto line = source_.next();
      if (!line) return tl::unexpected(line.error());
      if (!line->has_value()) break;
      split_words(**line, words);
      if (words.empty() || words.front().front() == '#') continue;
      if (auto taken = take(Fields(source_, words)); !taken) return tl::unexpected(taken.error());
    }
    return finish();
  }

 private:
  Status take(const Fields& f) {
    const std::string_view tag = f.word(0);
    if (tag == "VERTEX_SE2") return take_vertex(f, Format::kG2o);
    if (tag == "VERTEX2") return take_vertex(f, Format::kToro);
    if (tag == "EDGE_SE2") return take_edge(f, Format::kG2o, kG2oOrder);
    if (tag == "EDGE2") return take_edge(f, Format::kToro, kToroOrder);
    if (tag == "FIX") return take_fix(f);
    return f.bad(0, "tag", "VERTEX_SE2, EDGE_SE2 or FIX (g2o), VERTEX2 or EDGE2 (TORO)");
  }

  Status expect_format(const Fields& f, Format format) {
    if (!format_) format_ = format;
    if (*format_ == format) return {};
    return f.bad(
        0, "tag",
        *format_ == Format::kG2o ? "tags of g2o, as the lines before" : "tags of TORO, as the lines before");
  }

  Status take_vertex(const Fields& f, Format format) {
    if (auto s = expect_format(f, format); !s) return s;
    if (auto s = f.expect_count(5, "TAG id x y theta"); !s) return s;
    const auto id = f.count_field(1, "id", 0, kIdMax);
    if (!id) return tl::unexpected(id.error());
    const auto pose = f.pose(2, "pose");
    if (!pose) return tl::unexpected(pose.error());
    if (!vertices_.emplace(*id, *pose).second) return f.bad(1, "id", "a node that no line before has given");
    return {};
  }

  Status take_edge(const Fields& f, Format format, const std::array<std::size_t, 6>& order) {
    if (auto s = expect_format(f, format); !s) return s;
    if (auto s = f.expect_count(12, format == Format::kG2o ? "TAG from to x y theta I11 I12 I13 I22 I23 I33"
                                                           : "TAG from to x y theta I11 I12 I22 I33 I13 I23");
        !s)
      return s;
    const auto from = f.count_field(1, "from", 0, kIdMax), to = f.count_field(2, "to", 0, kIdMax);
    if (!from) return tl::unexpected(from.error());
    if (!to) return tl::unexpected(to.error());
    if (*from == *to) return f.bad(2, "to", "another node than the edge comes from");
    const auto pose = f.pose(3, "measured pose");
    if (!pose) return tl::unexpected(pose.error());
    const auto information = read_information(f, order);
    if (!information) return tl::unexpected(information.error());
    edges_.push_back({*from, *to, {0, 0, *pose, *information, false}, source_.line()});
    return {};
  }

  Result<Eigen::Matrix3d> read_information(const Fields& f, const std::array<std::size_t, 6>& order) {
    Eigen::Matrix3d information;
    std::size_t k = 0;
    for (int r = 0; r < 3; ++r) {
      for (int c = r; c < 3; ++c) {
        const auto entry = f.number(6 + order[k++], "information", -kInformationMax, kInformationMax);
        if (!entry) return tl::unexpected(entry.error());
        information(r, c) = information(c, r) = *entry;
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(information, Eigen::EigenvaluesOnly);
    const double least = parts.eigenvalues()[0], greatest = parts.eigenvalues()[2];
    if (!(greatest > 0.0) || least < -1e-9 * greatest) {
      return source_.bad(
          fmt::format("an information matrix with eigenvalues {:.3g} to {:.3g}", least, greatest),
          "a positive semidefinite one that is not zero");
    }
    return information;
  }

  Status take_fix(const Fields& f) {
    if (auto s = expect_format(f, Format::kG2o); !s) return s;
    if (auto s = f.expect_count(2, "FIX id"); !s) return s;
    const auto id = f.count_field(1, "id", 0, kIdMax);
    if (!id) return tl::unexpected(id.error());
    if (fixed_)
      return f.bad(1, "id", "one fixed node: it takes the freedom of the whole, more would bend it");
    fixed_ = std::pair(std::uint64_t{*id}, source_.line());
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
    std::map<std::uint64_t, std::size_t> index;
    for (const auto& [id, pose] : vertices_) {
      index.emplace(id, file.ids.size());
      file.ids.push_back(id);
      if (estimated) file.poses.push_back(pose);
    }
    for (NamedEdge& named : edges_) {
      for (const std::uint64_t id : {named.from, named.to}) {
        if (!index.contains(id))
          return bad_at(named.line, fmt::format("an edge to node {}", id), "nodes that have a vertex line");
      }
      named.edge.from = index.at(named.from);
      named.edge.to = index.at(named.to);
      file.edges.push_back(named.edge);
    }
    if (fixed_) {
      const auto found = index.find(fixed_->first);
      if (found == index.end())
        return bad_at(fixed_->second, fmt::format("FIX of node {}", fixed_->first), "a node of the graph");
      file.fixed = found->second;
    }
    if (!slam::is_connected(file.ids.size(), file.edges))
      return bad_at(source_.line(), "nodes without a chain of edges between them", "a graph in one piece");
    return file;
  }

  LineSource source_;
  std::optional<Format> format_;
  std::map<std::uint64_t, types::Se2> vertices_;
  std::vector<NamedEdge> edges_;
  std::optional<std::pair<std::uint64_t, int>> fixed_;  ///< id and line
};

}  // namespace

Result<GraphFile> read_graph(LineSource source) { return Reader(std::move(source)).run(); }

Result<GraphFile> read_graph(const std::string& path) {
  auto source = LineSource::open(path);
  if (!source) return tl::unexpected(source.error());
  return read_graph(std::move(*source));
}

}  // namespace topo::bench
