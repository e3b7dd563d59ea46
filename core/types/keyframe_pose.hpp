// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::types {

/// Corrected pose of one keyframe, for paths and pictures.
struct KeyframePose {
  Stamp stamp{};
  Transform2<Map, Base> T_map_base;
};

}  // namespace topo::types
