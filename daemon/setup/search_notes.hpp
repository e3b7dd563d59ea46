// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

namespace topo::daemon {

/// A place at which neither a scanner nor a base was found.
struct Fruitless {
  std::string address;
  bool answers = false;   ///< something is there, and does not say in time what it is
  std::string complaint;  ///< of a driver, which may begin with the address; empty: nothing answers
};

/// What is told of these places, a sentence each. What holds for several of them is told once: all units of a
/// CAN interface that is switched off have one reason.
[[nodiscard]] std::vector<std::string> notes_of(std::span<const Fruitless> places);

}  // namespace topo::daemon
