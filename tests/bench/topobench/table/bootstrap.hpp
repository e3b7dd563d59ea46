// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "tests/bench/topobench/table/paired_ratio.hpp"

namespace topo::bench {

/// 95 % interval of exp(mean) of values drawn again and again from these, with replacement (Efron 1979, the
/// percentile interval): what other buildings of the kind would give, without a law of how they differ. Of
/// few values it comes out too narrow; one alone says nothing. The same values give the same interval:
/// 10,000 drawings from a fixed seed.
Interval bootstrap_95(std::span<const double> logs);

}  // namespace topo::bench
