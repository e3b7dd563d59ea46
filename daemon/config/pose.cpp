// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/pose.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace topo::daemon {
namespace {

constexpr std::string_view kUnknown = "unknown";
constexpr std::array<double, 3> kLargest{1e4, 1e4, 360.0};  // m, m, degrees

}  // namespace

bool read_pose(const toml::node& node, std::optional<types::Se2>& pose) {
  if (const auto* text = node.as_string()) {
    if (text->get() != kUnknown) return false;
    pose.reset();
    return true;
  }
  const auto* list = node.as_array();
  if (list == nullptr || list->size() != kLargest.size()) return false;
  std::array<double, 3> read{};
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto number = (*list)[i].value<double>();
    if (!(*list)[i].is_number() || !number || !(std::abs(*number) <= kLargest[i])) return false;
    read[i] = *number;
  }
  pose = types::Se2{read[0], read[1], types::wrap_angle(read[2] * types::kDegree_rad)};
  return true;
}

std::string pose_text(const std::optional<types::Se2>& pose) {
  if (!pose) return fmt::format("\"{}\"", kUnknown);
  // Twelve digits: degrees that become radians and degrees again are the same text.
  return fmt::format("[{:#.12g}, {:#.12g}, {:#.12g}]", pose->x_m, pose->y_m,
                     pose->theta_rad / types::kDegree_rad);
}

}  // namespace topo::daemon
