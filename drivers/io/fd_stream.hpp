// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "drivers/io/byte_stream.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {

/// What serial ports and sockets have in common: a non-blocking descriptor waited for with poll(2).
/// Errors carry the device's name. Nothing allocates unless it fails.
class FdStream : public ByteStream {
 public:
  FdStream(UniqueFd fd, std::string name) : fd_(std::move(fd)), name_(std::move(name)) {}

  Result<ReadResult> read(std::span<std::byte> buffer, Duration timeout) override;
  Status write(std::span<const std::byte> bytes, Duration timeout) override;
  [[nodiscard]] Stamp now() const override;

 protected:
  [[nodiscard]] int fd() const { return fd_.get(); }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  /// One write(2) or send(2): bytes taken, or -1 with errno.
  virtual ssize_t write_some(std::span<const std::byte> bytes) = 0;

  UniqueFd fd_;
  std::string name_;
};

}  // namespace topo::io
