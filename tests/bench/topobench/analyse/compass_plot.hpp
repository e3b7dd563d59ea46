// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/compass/compass.hpp"
#include "daemon/mapfile/picture.hpp"

namespace topo::bench {

/// Entropy over orientation as the paper's figure 5 has it: half a turn from left to right (the second
/// quarter repeats the first), a grey line every ten degrees, red ones at the compass angle and its partner.
/// White paper when there is no curve.
daemon::Picture compass_plot(const compass::Compass& compass);

}  // namespace topo::bench
