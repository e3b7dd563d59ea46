// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/types/result.hpp"

namespace topo::daemon {

/// The whole text of a file. kNotFound, kPermission, kIo.
types::Result<std::string> read_text(const std::string& file);

/// Writes `text` as configuration `file` when it has no fault, keeping the file that was there as
/// `file`.N, the first number that is free. The name of what was kept; empty when there was nothing. Errors:
/// kInvalidInput with all faults of the text, kIo, kPermission; the file is as it was then.
types::Result<std::string> replace_configuration(const std::string& file, std::string_view text);

}  // namespace topo::daemon
