// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tests/integration/wire_rig.hpp"

namespace topo::test {

/// True when the environment variable TOPOMETRIC_FAULT_CROSS is a number of seeds: every fault on all wires,
/// with sonar and without, with so many seeds.
bool is_cross();

/// On which wires, with or without sonar, and with which seeds the fault of this number is tried: one setup
/// of the four in turn, or the whole cross.
std::vector<WireSetup> setups_of(std::size_t number);

/// "", or the seed for the name of a case of the cross.
std::string suffix_of(const WireSetup& setup);
/// "wires: TCP, without sonar".
std::string form_of(const WireSetup& setup);

}  // namespace topo::test
