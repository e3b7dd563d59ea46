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
  std::span<const std::byte> more{};  ///< after them
};

/// Writes files atomically: after a crash or power loss each is complete or absent. Every file is written to
/// a temporary file in the same folder and synchronised to the disk; then all are renamed and their folders
/// synchronised. When one cannot be written, none is replaced (after a failed rename, earlier files may
/// already be replaced) and no temporary file remains. Blocks on the disk. Errors name the file.
types::Status write_files(std::span<const FileContent> files);

inline types::Status write_file(const std::string& path, std::span<const std::byte> bytes) {
  const FileContent one{path, bytes};
  return write_files({&one, 1});
}
inline types::Status write_file(const std::string& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text)));
}

/// Removes a file and synchronises its folder; a file or folder that is not there is no error. Blocks on the
/// disk. Errors name the file; the file may be back after a loss of power then.
types::Status remove_file(const std::string& path);

}  // namespace topo::daemon
