// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/cell_run.hpp"
#include "core/grid/dense_map.hpp"

namespace topo::places {

/// These cells, ascending, and their eight neighbours, without those at the array's border; ascending, each
/// once.
std::vector<grid::CellRun> cells_and_beside(const grid::DenseMap& map, std::span<const std::uint32_t> cells);

}  // namespace topo::places
