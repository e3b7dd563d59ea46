// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "drivers/io/byte_stream.hpp"

namespace topo::io {

/// Opens a serial device (RS-232, USB CDC-ACM, pseudo terminal): raw, 8N1, no flow control, never the
/// controlling terminal, locked against every other program (TIOCEXCL and flock).
class SerialConnector final : public Connector {
 public:
  /// `path`: the device file; `name`: the configured address, for messages.
  SerialConnector(std::string path, std::string name) : path_(std::move(path)), name_(std::move(name)) {}

  /// Opening a local device does not wait: `timeout` is unused. kBusy when another program holds the device.
  Result<std::unique_ptr<ByteStream>> connect(Duration timeout) override;
  [[nodiscard]] std::string_view name() const override { return name_; }

 private:
  std::string path_;
  std::string name_;
};

}  // namespace topo::io
