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

/// A classic CAN 2.0A frame that came.
struct CanFrame {
  std::uint16_t id = 0;  ///< 11 bits
  CanData data;
  types::Stamp stamp{};  ///< when the kernel had it, on the host's steady clock
};

/// Nothing (the time was up), a frame, or what the controller reports.
using CanEvent = std::variant<std::monostate, CanFrame, CanError>;

/// Frames in and out of one CAN interface; the seam between ISO-TP and the kernel. One thread.
class CanPort {
 public:
  virtual ~CanPort() = default;

  /// Waits at most `timeout`. Error kClosed when the interface was switched off or is gone, kIo otherwise.
  virtual types::Result<CanEvent> receive(types::Duration timeout) = 0;

  /// Never waits. kBusy: the interface's queue is full, try again later; kClosed, kIo.
  virtual types::Status send(std::uint16_t id, const CanData& data) = 0;
  /// The same, past what waits in the queue.
  virtual types::Status send_first(std::uint16_t id, const CanData& data) = 0;

  /// Frames that the kernel had to drop because nobody fetched them, since the port was opened.
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;
  [[nodiscard]] virtual types::Stamp now() const = 0;
  /// As the configuration names it.
  [[nodiscard]] virtual std::string_view name() const = 0;
};

}  // namespace topo::io
