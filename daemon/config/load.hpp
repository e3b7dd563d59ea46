// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"

namespace topo::daemon {

/// A position in the file, line and column counted from 1. 0: not in the file.
struct Place {
  int line = 0;
  int column = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// One fault of a configuration file.
struct Fault {
  Place place;
  std::string message;  ///< names the key, the value found and the accepted values
  friend auto operator<=>(const Fault&, const Fault&) = default;
};

/// The contents of a file and all its faults. The values may be used only when there is no fault.
struct LoadedConfiguration {
  Configuration values;
  std::string file;
  std::map<std::string, Place, std::less<>> places;  ///< of every key that the file sets
  std::vector<Fault> faults;                         ///< in the order of the file
};

/// Reads a configuration. Reports all faults at once: syntax, unknown keys, wrong types, values out of range,
/// missing keys, contradictions. `file` is the name for messages.
LoadedConfiguration parse_configuration(std::string_view text, std::string file);

/// As parse_configuration(), for a file. Returns an Error only when the file cannot be read.
types::Result<LoadedConfiguration> load_configuration(const std::string& file);

/// "FILE:LINE:COLUMN: message", one per line.
std::string faults_text(const LoadedConfiguration& loaded);

/// Every key with its effective value and, as a comment, its origin: "default" or FILE:LINE. An absent
/// coronal scanner or team is left out. Reading the text gives the same configuration.
std::string effective_text(const LoadedConfiguration& loaded);

}  // namespace topo::daemon
