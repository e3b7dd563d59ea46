// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/slam/log_relations.hpp"

#include <fmt/format.h>

namespace topo::bench {

types::Result<std::vector<Relation>> read_relations_of(const CarmenLog& log, const std::string& path) {
  auto relations = read_relations(path);
  if (!relations) return relations;
  std::vector<TimedPose> stamps;  // that some relation finds its stamps does not depend on the poses
  for (const CarmenScan& scan : log.scans) stamps.push_back({scan.stamp_s, {}});
  if (evaluate_relations(*relations, stamps).used > 0) return relations;
  const Relation& first = relations->front();
  return types::fail(
      types::Errc::kInvalidInput,
      fmt::format("{}: none of {} relations has its stamps in the log: found {:.3f} and {:.3f} in the first, "
                  "expected stamps from {:.3f} to {:.3f}",
                  path, relations->size(), first.t1_s, first.t2_s, log.scans.front().stamp_s,
                  log.scans.back().stamp_s));
}

}  // namespace topo::bench
