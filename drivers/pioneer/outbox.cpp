// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/outbox.hpp"

#include <utility>

#include "core/types/invariant.hpp"

namespace topo::pioneer {

bool Outbox::push(const CommandPacket& packet) {
  if (count_ == kCapacity) return false;
  queue_[(first_ + count_) % kCapacity] = packet;
  ++count_;
  return true;
}

void Outbox::give_back(const CommandPacket& packet) {
  if (count_ == kCapacity) return;
  first_ = (first_ + kCapacity - 1) % kCapacity;
  queue_[first_] = packet;
  ++count_;
}

void Outbox::set_velocity(const Setpoints& setpoints) {
  v_mmps_ = setpoints.v_mmps;
  omega_degps_ = setpoints.omega_degps;
}

void Outbox::clear() {
  estop_ = false;
  v_mmps_.reset();
  omega_degps_.reset();
  first_ = count_ = 0;
}

CommandPacket Outbox::pop() {
  if (std::exchange(estop_, false)) return encode(Command::kEStop);
  if (const auto v = std::exchange(v_mmps_, std::nullopt)) return encode(Command::kVel, *v);
  if (const auto omega = std::exchange(omega_degps_, std::nullopt)) return encode(Command::kRvel, *omega);
  types::require(count_ > 0, "pioneer::Outbox: popped while empty");
  const CommandPacket packet = queue_[first_];
  first_ = (first_ + 1) % kCapacity;
  --count_;
  return packet;
}

}  // namespace topo::pioneer
