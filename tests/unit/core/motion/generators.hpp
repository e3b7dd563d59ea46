// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

namespace topo::motion {

/// Any number of the interval, for properties; both ends included.
inline double uniform(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100001) * 1e-5);
}

}  // namespace topo::motion
