// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "core/types/sector.hpp"

namespace topo::daemon {

/// For messages: what read_sectors() accepts.
inline constexpr std::string_view kSectorsForm =
    "at most 8 sectors [[from, to], ...] in degrees from -360 to 360, each from the smaller to the greater "
    "and "
    "less than a turn";

/// Reads [[from, to], ...] in degrees. False, and `sectors` unchanged: the node is something else.
[[nodiscard]] bool read_sectors(const toml::node& node, types::Sectors& sectors);
/// Sectors in the form that read_sectors() accepts.
[[nodiscard]] std::string sectors_text(const types::Sectors& sectors);

/// Bounds of what the front scanner may leave out of the sector that braking needs
/// (perception::StopZoneParams::forward_sector_rad to either side of straight ahead).
struct MaskBounds {
  double one_rad = 10.0 * types::kDegree_rad;  ///< a post of 5 cm, 0.3 m from the scanner
  /// Together; gate and plausibility need half of the sector (motion::GateParams::valid_share_min), and keep
  /// as much again for what fails of itself.
  double share = 0.25;
  double ahead_rad = 15.0 * types::kDegree_rad;  ///< to either side: what the hull drives into within a metre
};

/// Empty when braking sees enough beside these masks of the front scanner; otherwise what is too much and
/// what would be right.
[[nodiscard]] std::string masks_fault(const types::Sectors& masks, const MaskBounds& bounds = {});

}  // namespace topo::daemon
