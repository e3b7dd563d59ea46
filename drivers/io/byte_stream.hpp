// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"
#include "drivers/io/bus_faults.hpp"

namespace topo::io {

using types::Duration;
using types::Result;
using types::Stamp;
using types::Status;

/// Result of one read.
struct ReadResult {
  std::size_t bytes = 0;  ///< 0: no input before the time-out
  Stamp stamp{};          ///< time at which the bytes were available, on the host's steady clock
};

/// The only interface between the connections and the outside world: an open, ordered stream of bytes to a
/// device. Serial ports, TCP sockets, CAN (one packet per message), recordings and test doubles are byte
/// streams. One thread uses a stream; streams are not thread-safe. No call allocates unless it fails.
class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// Waits at most `timeout` for input and returns the available bytes, up to the buffer's size. Error
  /// kClosed when the peer or device is gone, kIo otherwise; a time-out is not an error.
  virtual Result<ReadResult> read(std::span<std::byte> buffer, Duration timeout) = 0;

  /// Writes all bytes or fails: kTimeout when they could not be written in time, kClosed, kIo.
  virtual Status write(std::span<const std::byte> bytes, Duration timeout) = 0;

  /// False while the last write is still in progress on a transport that carries one packet at a time. Only a
  /// stop may be written then, which aborts the write in progress; read() returns with 0 bytes when it has
  /// ended.
  [[nodiscard]] virtual bool ready() const { return true; }

  /// Faults since the stream was opened; none on a transport that is not a bus.
  [[nodiscard]] virtual BusFaults faults() const { return {}; }

  /// Sets the line speed of a serial port. Other transports have none and succeed without effect.
  virtual Status set_baud(int baud) = 0;

  /// True when the line has a speed that a connection may have to search for (an RS-232 line).
  [[nodiscard]] virtual bool has_baud() const = 0;

  /// Current time, on the clock that stamps the reads.
  [[nodiscard]] virtual Stamp now() const = 0;
};

/// Opens a stream to one configured device, and reopens it after every loss.
class Connector {
 public:
  virtual ~Connector() = default;
  /// Errors: kNotFound, kPermission, kBusy, kTimeout or kIo, with the device's name in the message.
  virtual Result<std::unique_ptr<ByteStream>> connect(Duration timeout) = 0;
  /// Address in the configuration: "/dev/ttyUSB0", "tcp:192.168.0.10:10940".
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// The clock of the streams, for use without a stream: back-off between attempts.
  [[nodiscard]] virtual Stamp now() const;
  /// Waits on that clock. Replays and test doubles advance their own clock instead.
  virtual void pause(Duration duration);
};

}  // namespace topo::io
