// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/types/result.hpp"

namespace topo::daemon {

struct FileContent {
  std::string path;
  std::span<const std::byte> bytes;
};

/// Writes files that are there as a whole or not at all, whatever is killed or pulled meanwhile: each into a
/// temporary file of the same folder, brought to the disk, then all renamed and their folders brought to the
/// disk. When one cannot be written, none is replaced (a failed rename can leave the ones before it replaced)
/// and no temporary file stays. Blocks on the disk. Errors name the file.
types::Status write_files(std::span<const FileContent> files);

inline types::Status write_file(const std::string& path, std::span<const std::byte> bytes) {
  const FileContent one{path, bytes};
  return write_files({&one, 1});
}
inline types::Status write_file(const std::string& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace topo::daemon
