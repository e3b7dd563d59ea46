// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/bench/carmen/relations.hpp"

namespace topo::bench {

/// Lines `t x y theta` with rising t, as toposim --truth and the daemon's trajectory.txt have them; # begins
/// a comment. Errors name file and line, what was found and what is expected; a file without a pose is one.
types::Result<std::vector<TimedPose>> read_poses(const std::string& path);

/// Between the two poses around the stamp; nothing outside.
std::optional<types::Se2> pose_at(std::span<const TimedPose> poses, double stamp_s);

}  // namespace topo::bench
