// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/io/byte_stream.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {

/// Opens a TCP connection: TCP_NODELAY; a dead peer or a pulled cable is detected within about 4 s (keepalive
/// after 1 s, every 1 s, three times; unacknowledged writes 3 s).
class TcpConnector final : public Connector {
 public:
  /// `host`: a numeric address, or a name that is resolved at every attempt (which can block beyond the
  /// time-out when a name server does not answer: use numbers on a robot).
  TcpConnector(std::string host, std::uint16_t port, std::string name);

  /// kTimeout: the attempt is still in progress, and the next call continues it (a call's time-out may be far
  /// shorter than a handshake over a bad link). An attempt without any answer is dropped after 3 s.
  Result<std::unique_ptr<ByteStream>> connect(Duration timeout) override;
  [[nodiscard]] std::string_view name() const override { return name_; }

 private:
  struct Attempt {
    UniqueFd fd;
    Stamp started{};
  };
  Result<Attempt> start() const;

  std::string host_;
  std::uint16_t port_;
  std::string name_;
  std::optional<Attempt> attempt_;
};

}  // namespace topo::io
