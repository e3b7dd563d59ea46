// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "daemon/recording/format.hpp"
#include "drivers/io/unique_fd.hpp"

struct ZSTD_CCtx_s;

namespace topo::daemon {

/// Packs frames and appends them to a recording. Used by one thread. A frame that cannot be written
/// completely is removed again, so that the file always ends with a complete frame; the next frame is tried
/// independently.
class FrameWriter {
 public:
  /// Creates the file (never over an existing one) and writes the header.
  static types::Result<FrameWriter> create(const std::string& path, const RecordingHeader& header);

  /// Packs and writes complete records. On an error the frame is lost and the file is unchanged.
  types::Status write(std::span<const std::byte> records, std::uint32_t channel_mask);

  /// Brings the written frames to the disk.
  types::Status sync();

  [[nodiscard]] std::uint64_t file_bytes() const { return size_; }

 private:
  struct FreeContext {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  FrameWriter(std::string path, io::UniqueFd fd);
  types::Status append(std::span<const std::byte> bytes);

  std::string path_;
  io::UniqueFd fd_;
  std::unique_ptr<ZSTD_CCtx_s, FreeContext> context_;
  std::vector<std::byte> frame_;  ///< head and packed bytes
  std::uint64_t size_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace topo::daemon
