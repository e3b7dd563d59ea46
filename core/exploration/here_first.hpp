// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/exploration/judged.hpp"
#include "core/types/area_limits.hpp"

namespace topo::exploration {

/// How far beside an area an opening still leads into it: a door stands in the wall around a room.
inline constexpr double kBesideArea_m = 0.5;

/// The candidates that come first: those whose opening is in one of the areas. Empty when there is none.
Judged here_first(const Judged& all, std::span<const types::Polygon> areas);

}  // namespace topo::exploration
