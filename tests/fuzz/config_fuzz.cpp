// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Configuration files of any content: faults are told with a place in the file, and what is accepted reads
// back.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "daemon/config/load.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto loaded = topo::daemon::parse_configuration(text, "fuzz.toml");
  const auto lines = static_cast<std::ptrdiff_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  for (const auto& fault : loaded.faults) {
    if (fault.message.empty() || fault.place.line < 0 || fault.place.line > lines + 1) std::abort();
  }
  if (!loaded.faults.empty()) return topo::daemon::faults_text(loaded).empty() ? (std::abort(), 0) : 0;
  const auto again = topo::daemon::parse_configuration(topo::daemon::effective_text(loaded), "again.toml");
  if (!again.faults.empty()) std::abort();
  return 0;
}
