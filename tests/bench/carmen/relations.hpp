// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "core/types/se2.hpp"

namespace topo::bench {

/// A pose difference verified by a person (Kuemmerle et al., On Measuring the Accuracy of SLAM Algorithms,
/// 2009): the pose at t2 in the frame of the pose at t1.
struct Relation {
  double t1_s = 0.0;
  double t2_s = 0.0;
  types::Se2 relative;
};

struct TimedPose {
  double stamp_s = 0.0;
  types::Se2 pose;
};

/// Errors of a trajectory; standard deviations are of the population, as in the authors' evaluator.
struct RelationErrors {
  int used = 0;
  int skipped = 0;  ///< no pose within the tolerance of t1 or t2
  double trans_mean_m = 0.0;
  double trans_std_m = 0.0;
  double trans_max_m = 0.0;
  double rot_mean_rad = 0.0;
  double rot_std_rad = 0.0;
  double rot_max_rad = 0.0;
};

/// Reads lines `t1 t2 x y z roll pitch yaw`, compressed (.gz, .bz2) or not; `#` begins a comment. Errors give
/// the file, the line, the value found and the expected form; a file without a relation is kInvalidInput.
types::Result<std::vector<Relation>> read_relations(const std::string& path);

/// Takes the pose nearest in time to t1 and t2, at most `tolerance_s` away, and compares their difference
/// with the relation: length of the difference of the translations, and the wrapped difference of the
/// headings. Precondition: `trajectory` is sorted by stamp. All relations are skipped when it is empty.
RelationErrors evaluate_relations(std::span<const Relation> relations, std::span<const TimedPose> trajectory,
                                  double tolerance_s = 0.1);

}  // namespace topo::bench
