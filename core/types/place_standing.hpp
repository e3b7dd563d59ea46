// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::types {

/// How far the robot's place in the map is known, apart from the localisation of single scans.
enum class PlaceStanding : std::uint8_t {
  kKnown,     ///< a fact, or confirmed by the operator
  kUnknown,   ///< the map that goes on is not there, or the robot was not found in it: no area limit can be
              ///< kept
  kProposed,  ///< found in a map that goes on, and not certain: the robot stands until the operator confirms
  kDropped,   ///< the first metres did not match the map: the robot stands until the operator decides
};

}  // namespace topo::types
