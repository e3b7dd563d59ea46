// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"

namespace topo::team::testing {

/// Of tests in this room: seconds after some moment.
inline types::Stamp at(double seconds) { return types::stamp_from_seconds(1'000.0 + seconds); }

}  // namespace topo::team::testing
