// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace topo::test {

/// One line of doc/faults.md: a fault, and what was seen of it.
struct FaultRow {
  std::string fault;  ///< "device: what is wrong"; with `form` the key of the row
  std::string form;   ///< "values, at 0.7 m/s", "wires", or where it runs instead
  std::string does;   ///< way and time to a standstill
  std::string says;   ///< doubt, reason of the gate, or line of health
  std::string back;   ///< how the robot comes back when the fault is over
};

/// Puts the row into the table that the environment variable TOPOMETRIC_FAULT_TABLE names, in place of an
/// older row of the same key, and sorts the table; without the variable nothing. Several processes may do it
/// at once. A table that cannot be written fails the test.
void record(const FaultRow& row);

/// "stands after 0.52 m, 1.55 s".
std::string stands_after(double way_m, double time_s);

}  // namespace topo::test
