// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace topo::daemon {

/// A scanner that streams, as it tells of itself.
struct FoundScanner {
  std::string address;  ///< as the configuration has it
  std::string product, serial_number;
};

/// A base that took up a connection.
struct FoundBase {
  std::string address;
  std::string name, subclass;
  std::string serial_number;  ///< empty: it tells none
  std::string chassis;        ///< "p3dx" or "p3at"; empty: its subclass names no family
  int watchdog_ms = 0;        ///< 0: it tells none
};

/// What a search for devices has found.
struct Found {
  std::vector<FoundScanner> scanners;
  std::vector<FoundBase> bases;
  std::vector<std::string> notes;  ///< what is in the way elsewhere, a sentence each
};

}  // namespace topo::daemon
