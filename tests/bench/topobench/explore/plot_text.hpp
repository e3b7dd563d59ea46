// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "tests/sim/picture.hpp"

namespace topo::bench {

/// Of a character with the gap behind it, in the picture's pixels.
inline constexpr double kTextWidth_px = 8.0;

/// Writes capitals of 6 x 10 pixels: letters of either case, digits, '-' and '.'; anything else is a gap. For
/// pictures of one metre a pixel: (x, y) is the upper left corner.
void write_text(sim::Picture& picture, double x, double y, std::string_view text, sim::Colour colour);

}  // namespace topo::bench
