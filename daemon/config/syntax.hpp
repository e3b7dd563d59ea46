// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/load.hpp"

namespace topo::daemon {

/// The readable part of a TOML document, and its syntax faults.
struct ParsedToml {
  toml::table root;
  std::vector<Fault> faults;
  std::vector<std::string> left_out;  ///< names of the keys on faulty lines
  bool complete = true;               ///< false: the text after the last fault was not read
};

/// Parses TOML. The library stops at the first fault; here a faulty "key = value" line is recorded and left
/// out and the rest is parsed again, so that one fault does not hide the others.
ParsedToml parse_toml(std::string_view text);

}  // namespace topo::daemon
