// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

#include "core/types/se2.hpp"

namespace topo::daemon {

/// For messages: what read_pose() accepts.
inline constexpr std::string_view kPoseForm =
    "[x, y, yaw] in metres and degrees, up to 10000 and 360 in magnitude, or \"unknown\"";

/// Reads a pose as people measure it: [x in m, y in m, yaw in degrees counter-clockwise], or "unknown", which
/// gives no pose. False, and `pose` unchanged: the node is neither.
[[nodiscard]] bool read_pose(const toml::node& node, std::optional<types::Se2>& pose);

/// A pose in the form that read_pose() accepts.
[[nodiscard]] std::string pose_text(const std::optional<types::Se2>& pose);

}  // namespace topo::daemon
