// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "core/perception/stop_zone.hpp"

namespace topo::perception {

/// Sonar echoes nearer than UnseenEchoParams::range_max_m that no laser hit explains: glass, and obstacles
/// lower than the laser's plane. Writes points on the transducers' axes, in base. Uses only recent echoes, of
/// transducers that point into the laser's field of view. Returns how many were written to `out`. Allocates
/// nothing.
std::size_t unseen_echoes(const Surroundings& around, const UnseenEchoParams& params,
                          std::span<types::Vector2> out);

}  // namespace topo::perception
