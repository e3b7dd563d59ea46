// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "daemon/recording/format.hpp"
#include "drivers/io/unique_fd.hpp"

struct ZSTD_DCtx_s;

namespace topo::daemon {

/// One record of a recording; `bytes` are valid until the cursor moves.
struct Record {
  std::size_t channel = 0;
  RecordKind kind = RecordKind::kFromDevice;
  types::Stamp stamp{};  ///< on the steady clock of the recording host
  std::span<const std::byte> bytes;
};

/// A recording opened for reading. Opening reads the header and the heads of the frames; cursors unpack and
/// check the contents. Constant after opening: any number of threads may read, each with its own cursor.
class RecordingReader {
 public:
  /// Errors give the file, the offset, the value found and the expected value: not a recording, another
  /// version, a damaged header; kNotFound, kPermission, kIo. A file that ends within a frame, or has a
  /// damaged frame head, opens up to there: see damage().
  static types::Result<std::shared_ptr<const RecordingReader>> open(const std::string& path);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t frames() const { return frames_.size(); }
  /// Frames that could not be written while recording: their numbers are missing.
  [[nodiscard]] std::uint64_t missing_frames() const { return missing_frames_; }
  /// Why reading ends before the file's end; nothing when all frames are complete.
  [[nodiscard]] const std::optional<types::Error>& damage() const { return damage_; }
  /// Index of a channel's name.
  [[nodiscard]] std::optional<std::size_t> channel(std::string_view name) const;

 private:
  friend class RecordingCursor;
  struct Frame {
    std::uint64_t offset = 0;  ///< of its head
    FrameHead head;
  };
  RecordingReader(std::string path, io::UniqueFd fd) : path_(std::move(path)), fd_(std::move(fd)) {}
  types::Status read_header();
  types::Status index_frames();
  /// Bytes at `offset`, fewer at the end of the file.
  types::Result<std::size_t> read_at(std::uint64_t offset, std::span<std::byte> out) const;
  [[nodiscard]] types::Error wrong(std::uint64_t offset, std::string_view found,
                                   std::string_view expected) const;

  std::string path_;
  io::UniqueFd fd_;
  RecordingHeader header_;
  std::uint64_t first_frame_ = 0;
  std::vector<Frame> frames_;
  std::uint64_t missing_frames_ = 0;
  std::optional<types::Error> damage_;
};

/// Iterates over the records of one channel, or of all, in the file's order, which within a channel is that
/// of the stamps. Used by one thread. Memory is allocated at construction.
class RecordingCursor {
 public:
  explicit RecordingCursor(std::shared_ptr<const RecordingReader> reader,
                           std::optional<std::size_t> channel = std::nullopt);

  /// The next record; nothing at the end, or at the reader's damage(). kInvalidInput for a frame with damaged
  /// content; the next call continues with the frame after it.
  types::Result<std::optional<Record>> next();

 private:
  struct FreeContext {
    void operator()(ZSTD_DCtx_s* context) const;
  };
  types::Result<bool> load_next_frame();
  types::Status load(std::uint64_t offset, const FrameHead& head);

  std::shared_ptr<const RecordingReader> reader_;
  std::optional<std::size_t> channel_;
  std::unique_ptr<ZSTD_DCtx_s, FreeContext> context_;
  std::vector<std::byte> packed_;
  std::vector<std::byte> raw_;
  std::span<const std::byte> rest_;  ///< remaining records of the loaded frame
  std::size_t next_frame_ = 0;
};

}  // namespace topo::daemon
