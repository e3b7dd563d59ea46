// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/sync/ring.hpp"
#include "core/sync/steps.hpp"

namespace topo::sync {

enum class Severity : std::uint8_t { kDebug, kInfo, kWarning, kError };

/// What a real-time thread has to say, unformatted. What `id` and `args` mean is the daemon's table.
struct Event {  // NOLINT(cppcoreguidelines-pro-type-member-init): text is filled up to text_length
  static constexpr std::size_t kMaxText = 48;

  std::int64_t stamp_ns = 0;
  std::array<std::int64_t, 3> args{};
  std::uint16_t id = 0;
  Severity severity = Severity::kInfo;
  std::uint8_t text_length = 0;
  std::array<char, kMaxText> text;  ///< the first text_length are set

  [[nodiscard]] std::string_view text_view() const {
    return {text.data(), std::min<std::size_t>(text_length, kMaxText)};
  }
  /// Cuts at kMaxText bytes, without splitting a UTF-8 character.
  void set_text(std::string_view t) noexcept {
    std::size_t length = std::min(t.size(), kMaxText);
    if (length < t.size()) {
      while (length > 0 && (static_cast<unsigned char>(t[length]) & 0xC0U) == 0x80U) --length;
    }
    std::copy_n(t.data(), length, text.data());
    text_length = static_cast<std::uint8_t>(length);
  }
};

/// From one real-time thread to the thread that formats and logs. Every call is wait-free; what finds no room
/// is lost, and counted.
template <std::size_t N, class Steps = Undisturbed>
class EventRing {
 public:
  /// Producer. False, and counted, when there is no room.
  bool post(std::int64_t stamp_ns, std::uint16_t id, Severity severity, std::array<std::int64_t, 3> args = {},
            std::string_view text = {}) noexcept {
    Event* e = ring_.try_acquire();
    if (e == nullptr) return false;
    e->stamp_ns = stamp_ns;
    e->id = id;
    e->severity = severity;
    e->args = args;
    e->set_text(text);
    ring_.commit();
    return true;
  }

  /// Consumer. The oldest event, good until pop; null when there is none.
  [[nodiscard]] const Event* front() noexcept { return ring_.front(); }
  void pop() noexcept { ring_.pop(); }

  /// Consumer. f(const Event&) for what is there, N at most, so that a chatty producer cannot keep the
  /// consumer. Returns how many.
  template <class F>
  std::size_t drain(F&& f) {
    std::size_t taken = 0;
    for (const Event* e = front(); e != nullptr && taken < N; e = front(), ++taken) {
      f(*e);
      pop();
    }
    return taken;
  }

  /// Any thread. Events that found no room since construction.
  [[nodiscard]] std::uint64_t lost() const noexcept { return ring_.rejected(); }

 private:
  Ring<Event, N, Steps> ring_;
};

}  // namespace topo::sync
