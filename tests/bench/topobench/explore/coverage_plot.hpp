// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/sim/picture.hpp"

namespace topo::bench {

/// Share of the area over time, with lines at 50, 90, 95 and 99 % and at round times, labelled.
sim::Picture coverage_plot(const RunResult& result);

}  // namespace topo::bench
