// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/slam/doubt/map_doubt.hpp"

namespace topo::daemon {

/// What speaks against a map, in a sentence for a person; empty when the map is not doubted.
[[nodiscard]] std::string doubt_text(const slam::MapDoubt& doubt);

/// The same, for doubt.json, status and `topobench slam`: figure (above 1 the map is
/// doubted), why, the shares, loose_rad, loose_m; `regions`: doubted squares of side_m (centre x_m, y_m,
/// points, contradicted); `loose`: steps of the way that odometry alone carries (x_m, y_m where it begins,
/// sigma_rad, sigma_m). Metres in map.
[[nodiscard]] nlohmann::json doubt_json(const slam::MapDoubt& doubt);

}  // namespace topo::daemon
