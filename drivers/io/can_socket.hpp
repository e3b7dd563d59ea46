// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>

#include "drivers/io/can_port.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {

/// Time of arrival of a frame that is `age` old. The kernel stamps frames with CLOCK_REALTIME, which may be
/// set at any moment: only the age counts. A negative age counts as 0; more than a second counts as one
/// second, so that an old frame never appears fresh.
[[nodiscard]] types::Stamp can_arrival(types::Stamp now, types::Duration age);

/// A CAN interface of the kernel (CAN_RAW): only the requested frames, with the kernel's stamps, and all
/// error frames. Urgent frames use a second socket with a higher priority: the queue of a CAN interface has
/// three bands.
class CanSocket final : public CanPort {
 public:
  /// `interface`: "can0"; `ids`: the frames to receive; `name`: for messages. kNotFound: no such interface,
  /// or it is not a CAN interface; kClosed: it is switched off.
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
  /// Fetches one waiting frame; nothing when none waits.
  types::Result<CanEvent> take();

  UniqueFd data_, first_;
  std::string name_;
  std::uint32_t dropped_ = 0;
};

}  // namespace topo::io
