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

/// What one read brought.
struct ReadResult {
  std::size_t bytes = 0;  ///< 0: nothing came before the time-out
  Stamp stamp{};          ///< when the bytes were there, on the host's steady clock
};

/// The one seam between the connections and the outside world: an open, ordered stream of bytes to a device.
/// Serial ports, TCP sockets, CAN (one packet a message), recordings and test doubles are byte
/// streams. One thread uses a stream; nothing here is thread-safe. No call allocates.
class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// Waits at most `timeout` for input and takes what is there, up to the buffer's size.
  /// Error kClosed when the peer or device is gone, kIo otherwise; a time-out is no error.
  virtual Result<ReadResult> read(std::span<std::byte> buffer, Duration timeout) = 0;

  /// Writes everything or fails: kTimeout when it did not go out in time, kClosed, kIo.
  virtual Status write(std::span<const std::byte> bytes, Duration timeout) = 0;

  /// False while what was written last is still under way on a transport that carries one packet at a time.
  /// Only a stop may be written then, which ends the other; read() returns with 0 bytes when it is over.
  [[nodiscard]] virtual bool ready() const { return true; }

  /// Since the stream was opened; none on a transport that is no bus.
  [[nodiscard]] virtual BusFaults faults() const { return {}; }

  /// Line speed of a serial port; other transports have none and succeed without doing anything.
  virtual Status set_baud(int baud) = 0;

  /// True where the line has a speed that a connection may have to search for (an RS-232 line).
  [[nodiscard]] virtual bool has_baud() const = 0;

  /// Now, on the clock that stamps the reads.
  [[nodiscard]] virtual Stamp now() const = 0;
};

/// Opens a stream to one configured device, again after every loss.
class Connector {
 public:
  virtual ~Connector() = default;
  /// kNotFound, kPermission, kBusy, kTimeout or kIo, with the device's name in the message.
  virtual Result<std::unique_ptr<ByteStream>> connect(Duration timeout) = 0;
  /// As the configuration names it: "/dev/ttyUSB0", "tcp:192.168.0.10:10940".
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// The clock of the streams, for the time when there is no stream: back-off between attempts.
  [[nodiscard]] virtual Stamp now() const;
  /// Waits on that clock. Replays and test doubles advance their own clock instead.
  virtual void pause(Duration duration);
};

}  // namespace topo::io
