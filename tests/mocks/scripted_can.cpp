// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/mocks/scripted_can.hpp"

#include <algorithm>

namespace topo::mocks {

void ScriptedCan::add(io::CanEvent event, types::Duration delay) {
  types::Stamp when = now + delay;
  if (!coming_.empty()) when = std::max(when, coming_.back().when);
  if (auto* frame = std::get_if<io::CanFrame>(&event)) frame->stamp = when;
  coming_.push_back({when, std::move(event)});
}

void ScriptedCan::arrive(std::uint16_t id, std::string_view data, types::Duration delay) {
  io::CanFrame frame;
  frame.id = id;
  frame.data.size = static_cast<std::uint8_t>(std::min(data.size(), frame.data.bytes.size()));
  std::transform(data.begin(), data.begin() + frame.data.size, frame.data.bytes.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  add(frame, delay);
}

void ScriptedCan::report(const io::CanError& error, types::Duration delay) { add(error, delay); }

std::vector<std::string> ScriptedCan::sent_on(std::uint16_t id) const {
  std::vector<std::string> found;
  for (const Sent& s : sent) {
    if (s.id == id) found.push_back(s.data);
  }
  return found;
}

void ScriptedCan::unblock() {
  blocked = false;
  for (auto* band : {&first_, &others_}) {
    for (; !band->empty(); band->pop_front()) put_on_wire(band->front());
  }
}

void ScriptedCan::put_on_wire(Sent frame) {
  frame.when = now;
  sent.push_back(frame);
  if (on_sent) on_sent(frame);
}

types::Result<io::CanEvent> ScriptedCanPort::receive(types::Duration timeout) {
  if (!bus_.gone.empty()) return types::fail(types::Errc::kClosed, bus_.gone);
  const types::Stamp until = bus_.now + std::max(timeout, types::Duration::zero());
  if (bus_.coming_.empty() || bus_.coming_.front().when > until) {
    bus_.now = until;
    return io::CanEvent{};
  }
  bus_.now = std::max(bus_.now, bus_.coming_.front().when);
  io::CanEvent event = std::move(bus_.coming_.front().event);
  bus_.coming_.pop_front();
  return event;
}

types::Status ScriptedCanPort::put(std::uint16_t id, const io::CanData& data, bool first) {
  if (!bus_.gone.empty()) return types::fail(types::Errc::kClosed, bus_.gone);
  auto& band = first ? bus_.first_ : bus_.others_;
  if (bus_.full || band.size() == bus_.capacity) return types::fail(types::Errc::kBusy, "queue full");
  const auto bytes = data.view();
  std::string text(bytes.size(), '\0');
  std::transform(bytes.begin(), bytes.end(), text.begin(), [](std::byte b) { return static_cast<char>(b); });
  ScriptedCan::Sent frame{id, std::move(text), bus_.now, first};
  if (bus_.blocked)
    band.push_back(std::move(frame));
  else
    bus_.put_on_wire(std::move(frame));
  return {};
}

std::string frame_bytes(std::string_view text) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 3)
    bytes.push_back(static_cast<char>(std::stoi(std::string(text.substr(i, 2)), nullptr, 16)));
  return bytes;
}

}  // namespace topo::mocks
