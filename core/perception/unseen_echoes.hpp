// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "core/perception/stop_zone.hpp"

namespace topo::perception {

/// Sonar echoes nearer than `range_max_m` where the laser sees nothing: glass, and what is lower than the
/// laser's plane. Points on the transducers' axes, in base. Only echoes of the last moments, and of
/// transducers that look where the laser does. Returns how many were written to `out`. Allocates nothing.
std::size_t unseen_echoes(const Surroundings& around, double range_max_m, std::span<types::Vector2> out);

}  // namespace topo::perception
