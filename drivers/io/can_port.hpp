// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"
#include "drivers/io/can_error.hpp"
#include "drivers/io/iso_tp.hpp"

namespace topo::io {

/// A received classic CAN 2.0A frame.
struct CanFrame {
  std::uint16_t id = 0;  ///< 11 bits
  CanData data;
  types::Stamp stamp{};  ///< time of reception by the kernel, on the host's steady clock
};

/// Nothing (time-out), a frame, or a report of the controller.
using CanEvent = std::variant<std::monostate, CanFrame, CanError>;

/// Frames in and out of one CAN interface: the interface between ISO-TP and the kernel. Used by one thread.
class CanPort {
 public:
  virtual ~CanPort() = default;

  /// Waits at most `timeout`. Error kClosed when the interface was switched off or is gone, kIo otherwise.
  virtual types::Result<CanEvent> receive(types::Duration timeout) = 0;

  /// Never waits. kBusy: the interface's queue is full, the caller may retry later; kClosed, kIo.
  virtual types::Status send(std::uint16_t id, const CanData& data) = 0;
  /// As send(), ahead of the frames that wait in the queue.
  virtual types::Status send_first(std::uint16_t id, const CanData& data) = 0;

  /// Frames that the kernel dropped because they were not fetched in time, since the port was opened.
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;
  [[nodiscard]] virtual types::Stamp now() const = 0;
  /// Address in the configuration.
  [[nodiscard]] virtual std::string_view name() const = 0;
};

}  // namespace topo::io
