// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"
#include "tests/sim/world.hpp"

namespace topo::bench {

/// 16 hexadecimal digits (XXH3) of what stands in a building: another drawing under the same name is another
/// building.
std::string fingerprint_of(const sim::World& world);

/// The same of this very program's file: a program that was built from something else may decide otherwise.
types::Result<std::string> fingerprint_of_program();

}  // namespace topo::bench
