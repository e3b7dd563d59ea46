// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/relations.hpp"

namespace topo::bench {

/// What a slower scanner or a lossy line leaves of a log.
struct Thinning {
  int every = 1;            ///< only each so many-th scan
  double drop_share = 0.0;  ///< of the scans that are left, at random
  std::uint64_t drop_seed = 1;
  [[nodiscard]] bool none() const { return every == 1 && drop_share == 0.0; }
};

/// Says of one scan after the other whether it is left. The first is.
class Thinner {
 public:
  explicit Thinner(const Thinning& thinning) : thinning_(thinning), random_(thinning.drop_seed) {}
  [[nodiscard]] bool keeps_next();

 private:
  Thinning thinning_;
  std::mt19937_64 random_;
  std::uint64_t scan_ = 0;
};

/// Takes scans out of a log, with the odometry that their messages carry.
void thin(CarmenLog& log, const Thinning& thinning);

/// The relations between two scans that are in the log. Logs have bursts of stamps that are milliseconds
/// apart while the robot drove on: the pose of another scan near in time is no measure there.
std::vector<Relation> between_scans(const std::vector<Relation>& relations, const CarmenLog& log);

}  // namespace topo::bench
