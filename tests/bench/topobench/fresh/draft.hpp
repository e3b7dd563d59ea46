// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {

/// A floor with doors and furniture, not yet checked: one to three wings, each in one of the layouts, of a
/// size that is drawn evenly by its logarithm.
FloorPlan draft_plan(sim::Random& random);

}  // namespace topo::bench::fresh
