// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "drivers/io/byte_stream.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {

/// Common part of serial ports and sockets: a non-blocking descriptor with poll(2). Errors carry the device's
/// name. No call allocates unless it fails.
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
