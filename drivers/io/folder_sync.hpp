// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"

namespace topo::io {

/// Brings the folder of `path` to the disk: a file that was created or renamed is there after a loss of power
/// only when its folder's entry is (fsync(2)). Blocks on the disk. Errors name the folder; a file system
/// that does not support it (FUSE, network) is no error.
[[nodiscard]] types::Status sync_folder_of(const std::string& path);

}  // namespace topo::io
