// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"

namespace topo::daemon {

/// Reads a whole file; kInvalidInput when it is larger than `max_bytes` or not a regular file. Errors name
/// the file.
types::Result<std::string> read_file(const std::string& path, std::size_t max_bytes);

/// Reads at most the first `bytes` of a file; errors as read_file().
types::Result<std::string> read_beginning(const std::string& path, std::size_t bytes);

/// "PATH: WHERE: found FOUND, expected EXPECTED"; WHERE is left out when `where` is empty.
tl::unexpected<types::Error> bad_file(const std::string& path, std::string_view where, std::string_view found,
                                      std::string_view expected);

}  // namespace topo::daemon
