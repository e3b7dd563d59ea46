// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/can_message.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace topo::sim::can {
namespace {

constexpr std::size_t kFrame = 8;
constexpr std::size_t kMessageMost = 4095;

unsigned at(std::string_view frame, std::size_t i) { return static_cast<unsigned char>(frame[i]); }

std::string frame_of(std::initializer_list<unsigned> head, std::string_view content) {
  std::string frame;
  for (const unsigned byte : head) frame.push_back(static_cast<char>(byte));
  frame.append(content.substr(0, kFrame - frame.size()));
  frame.resize(kFrame, '\xCC');
  return frame;
}

}  // namespace

bool is_flow(std::string_view frame) { return !frame.empty() && at(frame, 0) / 16 == 3; }

void Splitter::start(const std::string& message, SimTime now) {
  const auto size = static_cast<unsigned>(std::min(message.size(), kMessageMost));
  std::string_view rest = std::string_view(message).substr(0, size);
  first_sent_ = false;
  not_before_ = now;
  if (size < kFrame) {
    frames_.push_back(frame_of({size}, rest));
    return;
  }
  frames_.push_back(frame_of({0x10 + size / 256, size % 256}, rest));
  rest.remove_prefix(6);
  for (unsigned number = 1; !rest.empty(); ++number) {
    frames_.push_back(frame_of({0x20 + number % 16}, rest));
    rest.remove_prefix(std::min<std::size_t>(7, rest.size()));
  }
}

std::optional<std::string> Splitter::next(SimTime now) {
  if (frames_.empty() || now < not_before_) return std::nullopt;
  if (first_sent_ && allowed_ == 0) return std::nullopt;
  std::string frame = std::move(frames_.front());
  frames_.pop_front();
  if (!first_sent_) {
    first_sent_ = true;
    allowed_ = 0;
    patience_ends_ = now + kPatience;
  } else if (allowed_ > 0 && --allowed_ == 0) {
    patience_ends_ = now + kPatience;
  }
  if (allowed_ != 0) not_before_ = now + gap_;
  return frame;
}

void Splitter::on_flow(std::string_view frame, SimTime now) {
  if (!busy() || !first_sent_ || frame.size() < 3 || allowed_ != 0) return;
  const unsigned status = at(frame, 0) % 16;
  if (status == 1) {
    patience_ends_ = now + kPatience;
    return;
  }
  if (status != 0) return give_up();
  allowed_ = at(frame, 1) == 0 ? -1 : static_cast<int>(at(frame, 1));
  const unsigned gap = at(frame, 2);
  gap_ = gap < 0x80 ? SimTime{std::chrono::milliseconds{gap}} : SimTime{std::chrono::milliseconds{1}};
  not_before_ = now;
}

void Splitter::tick(SimTime now) {
  if (busy() && first_sent_ && allowed_ == 0 && now >= patience_ends_) give_up();
}

void Splitter::give_up() {
  frames_.clear();
  ++given_up_;
}

Assembler::Step Assembler::take(std::string_view frame, SimTime now) {
  if (whole_ > 0 && now > latest_) drop();
  const unsigned kind = frame.empty() ? 15 : at(frame, 0) / 16;
  if (kind == 1) return take_first(frame, now);
  if (kind == 2) return take_next(frame, now);
  const std::size_t size = kind == 0 ? at(frame, 0) % 16 : 0;
  if (size == 0 || size > 7 || frame.size() <= size) {
    ++broken_;
    return {};
  }
  if (whole_ > 0) drop();
  return {std::string(frame.substr(1, size)), std::nullopt};
}

Assembler::Step Assembler::take_first(std::string_view frame, SimTime now) {
  if (whole_ > 0) drop();
  const std::size_t size = frame.size() == kFrame ? at(frame, 0) % 16 * 256 + at(frame, 1) : 0;
  if (size < kFrame) {
    ++broken_;
    return {};
  }
  message_ = frame.substr(2);
  whole_ = size;
  number_ = 1;
  latest_ = now + kPatience;
  return {std::nullopt, frame_of({0x30, 0, 0}, {})};
}

Assembler::Step Assembler::take_next(std::string_view frame, SimTime now) {
  const std::size_t wanted = std::min<std::size_t>(7, whole_ - message_.size());
  if (whole_ == 0 || at(frame, 0) % 16 != number_ || frame.size() < wanted + 1) {
    drop();
    return {};
  }
  message_.append(frame.substr(1, wanted));
  number_ = (number_ + 1) % 16;
  latest_ = now + kPatience;
  if (message_.size() < whole_) return {};
  whole_ = 0;
  return {message_, std::nullopt};
}

void Assembler::drop() {
  whole_ = 0;
  ++broken_;
}

}  // namespace topo::sim::can
