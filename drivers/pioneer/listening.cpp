// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/listening.hpp"

#include <array>
#include <utility>

#include "drivers/pioneer/sip.hpp"

namespace topo::pioneer {
namespace {

constexpr std::array<int, 5> kListenedBauds{9600, 38400, 19200, 115200, 57600};  // PROTOCOLS section 1.2
/// Two status cycles, so that one packet comes whole.
constexpr types::Duration kAtOneSpeed = std::chrono::milliseconds(220);

}  // namespace

Listening::Listening(Link& link, int first_baud)
    : link_(link), first_baud_(first_baud), deadline_(link.now()) {}

Listening::Heard Listening::on_packet(const PacketView& packet) {
  if (packet.is(PacketType::kReset) || packet.is(PacketType::kResetWithDiagnosis)) return Heard::kReleased;
  const auto status = decode_status(packet.payload);
  if (!status) return Heard::kNothing;
  heard_ = true;
  stands_ = status->left_velocity == 0 && status->right_velocity == 0;
  return status->motors_enabled() ? Heard::kStatus : Heard::kReleased;
}

types::Status Listening::on_time() {
  if (link_.now() < deadline_) return {};
  deadline_ = link_.now() + kAtOneSpeed;
  return link_.has_baud() && !heard_ ? next_speed() : types::Status{};
}

types::Status Listening::next_speed() {
  if (!std::exchange(begun_, true) && first_baud_ != 0) return link_.set_baud(first_baud_);
  return link_.set_baud(kListenedBauds[index_++ % kListenedBauds.size()]);
}

}  // namespace topo::pioneer
