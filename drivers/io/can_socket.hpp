// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>

#include "drivers/io/can_port.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {

/// When a frame came that is `age` old. The kernel stamps frames with CLOCK_REALTIME, which may be set at any
/// moment: only the age counts. One that cannot be is none; more than a second counts as one, so that an old
/// frame is never a fresh one.
[[nodiscard]] types::Stamp can_arrival(types::Stamp now, types::Duration age);

/// A CAN interface of the kernel (CAN_RAW): only the frames that are asked for, with the kernel's stamps, and
/// all error frames. What must go first has a socket of its own with a higher priority: the queue of a CAN
/// interface has three bands.
class CanSocket final : public CanPort {
 public:
  /// `interface`: "can0"; `ids`: the frames to hear; `name`: for messages.
  /// kNotFound: no such interface, or it is no CAN interface; kClosed: it is switched off.
  static types::Result<std::unique_ptr<CanPort>> open(const std::string& interface,
                                                      std::span<const std::uint16_t> ids, std::string name);

  types::Result<CanEvent> receive(types::Duration timeout) override;
  types::Status send(std::uint16_t id, const CanData& data) override { return send_on(data_, id, data); }
  types::Status send_first(std::uint16_t id, const CanData& data) override {
    return send_on(first_, id, data);
  }
  [[nodiscard]] std::uint64_t dropped() const override { return dropped_; }
  [[nodiscard]] types::Stamp now() const override;
  [[nodiscard]] std::string_view name() const override { return name_; }

 private:
  CanSocket(UniqueFd data, UniqueFd first, std::string name)
      : data_(std::move(data)), first_(std::move(first)), name_(std::move(name)) {}
  types::Status send_on(const UniqueFd& socket, std::uint16_t id, const CanData& data) const;
  /// One frame that is there; nothing when none is.
  types::Result<CanEvent> take();

  UniqueFd data_, first_;
  std::string name_;
  std::uint32_t dropped_ = 0;
};

}  // namespace topo::io
