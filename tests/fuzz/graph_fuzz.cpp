// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Pose graph files of any content: refused with a place in the file, or a graph in one piece that the solver
// can be given.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>

#include "core/slam/linear_start.hpp"
#include "core/slam/spanning_start.hpp"
#include "tests/bench/topobench/posegraph/graph_file.hpp"

namespace {

class FuzzedSource final : public topo::bench::ByteSource {
 public:
  FuzzedSource(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}
  topo::types::Result<std::size_t> read(std::span<char> buffer) override {
    const std::size_t n = std::min(buffer.size(), rest_.size());
    if (n > 0) std::memcpy(buffer.data(), rest_.data(), n);
    rest_ = rest_.subspan(n);
    return n;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

void require(bool held) {
  if (!held) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto graph = topo::bench::read_graph(
      topo::bench::LineSource::over("fuzz.g2o", std::make_unique<FuzzedSource>(data, size)));
  if (!graph) {
    require(graph.error().message.starts_with("fuzz.g2o:"));
    require(graph.error().message.find("expected") != std::string::npos);
    return 0;
  }
  const std::size_t nodes = graph->names.size();
  require(nodes >= 2 && !graph->edges.empty());
  require(graph->poses.empty() || graph->poses.size() == nodes);
  require(graph->fixed.size() < 2 || !graph->poses.empty());
  for (const std::size_t node : graph->fixed) require(node < nodes);
  for (const auto& edge : graph->edges) require(edge.from < nodes && edge.to < nodes && edge.from != edge.to);
  // In one piece by edges alone, or by the nodes that are held.
  auto poses = topo::slam::spanning_start(nodes, graph->edges);
  require(poses.has_value() || graph->fixed.size() > 1);
  if (!poses) poses = graph->poses;
  const std::vector<std::size_t> fixed = graph->fixed.empty() ? std::vector<std::size_t>{0} : graph->fixed;
  (void)topo::slam::start_linearly(*poses, graph->edges, fixed);
  (void)topo::slam::solve(*poses, graph->edges, {}, fixed);
  for (const auto& pose : *poses) require(std::isfinite(pose.x_m) && std::isfinite(pose.theta_rad));
  return 0;
}
