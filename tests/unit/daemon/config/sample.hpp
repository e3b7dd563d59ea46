// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/load.hpp"

namespace topo::daemon {

/// The shortest configuration without a fault.
inline constexpr std::string_view kSmallest = R"([robot]
model = "p3dx"
[base]
address = "tcp:localhost:8101"
[scanner.front]
address = "tcp:localhost:10940"
)";

/// "LINE:COLUMN: message" of every fault.
inline std::vector<std::string> faults_of(std::string_view text) {
  std::vector<std::string> lines;
  for (const auto& fault : parse_configuration(text, "f.toml").faults) {
    lines.push_back(std::to_string(fault.place.line) + ":" + std::to_string(fault.place.column) + ": " +
                    fault.message);
  }
  return lines;
}

}  // namespace topo::daemon
