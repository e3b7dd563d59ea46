// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "core/places/segmentation/place_map.hpp"
#include "core/types/result.hpp"

namespace topo::bench {

/// Gives one parameter of the segmentation another value, for sweeps and ablations. The name is that of the
/// field, with its group: "density.min", "first.passage_ratio", "small_m2". kInvalidInput for a name that is
/// none, which lists them, and for a value that is not above zero.
types::Status set_place_param(std::string_view name, double value, places::PlaceParams& params);

}  // namespace topo::bench
