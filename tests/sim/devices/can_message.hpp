// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "tests/sim/devices/sim_time.hpp"

/// The simulator's own segmentation of messages (ISO 15765-2 on classic CAN, PROTOCOLS section 14.1). It
/// shares no code with the driver: only the vectors of PROTOCOLS section 16 are common to both.
namespace topo::sim::can {

inline constexpr SimTime kPatience = std::chrono::milliseconds{100};  ///< N_Bs and N_Cr

/// Splits messages into frames, one message at a time.
class Splitter {
 public:
  /// Begins a message; precondition: not busy.
  void start(const std::string& message, SimTime now);
  [[nodiscard]] bool busy() const { return !frames_.empty(); }
  /// The next frame that may be sent now, if there is one.
  std::optional<std::string> next(SimTime now);
  /// Handles the host's flow control: continue, wait or end.
  void on_flow(std::string_view frame, SimTime now);
  /// Gives up a message that was not answered in time, as a gateway does to avoid a stall.
  void tick(SimTime now);
  [[nodiscard]] std::uint64_t given_up() const { return given_up_; }

 private:
  void give_up();

  std::deque<std::string> frames_;
  bool first_sent_ = false;
  int allowed_ = 0;  ///< frames that may be sent before the next flow control; below 0: all
  SimTime gap_{0};
  SimTime not_before_{0};
  SimTime patience_ends_{0};
  std::uint64_t given_up_ = 0;
};

/// Reassembles messages.
class Assembler {
 public:
  struct Step {
    std::optional<std::string> message;  ///< complete with this frame
    std::optional<std::string> answer;   ///< flow control for the host
  };
  Step take(std::string_view frame, SimTime now);
  /// Frames that belong to no message, and messages that remained incomplete.
  [[nodiscard]] std::uint64_t broken() const { return broken_; }

 private:
  Step take_first(std::string_view frame, SimTime now);
  Step take_next(std::string_view frame, SimTime now);
  void drop();

  std::string message_;
  std::size_t whole_ = 0;  ///< bytes of the present message; 0: there is none
  unsigned number_ = 0;    ///< of the next frame
  SimTime latest_{0};
  std::uint64_t broken_ = 0;
};

/// True when the first four bits mark a flow control frame.
[[nodiscard]] bool is_flow(std::string_view frame);

}  // namespace topo::sim::can
