// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/types/invariant.hpp"
#include "core/types/scan.hpp"
#include "drivers/hokuyo/scip_codec.hpp"

namespace topo::hokuyo {

/// A reply that is not a scan: echo, status, and data lines with their check characters (the kind of check
/// depends on the command).
class Reply {
 public:
  static constexpr std::size_t kMaxLines = 16;   ///< the longest known reply has 9 (PP and an extra line)
  static constexpr std::size_t kMaxText = 1024;  ///< of all lines together; VV takes about 200

  [[nodiscard]] std::string_view echo() const { return {echo_.data(), echo_size_}; }
  /// Two characters; one in a reply of SCIP 1.1, which has no check character either.
  [[nodiscard]] std::string_view status() const { return {status_.data(), status_size_}; }
  [[nodiscard]] bool scip1() const { return status_size_ == 1; }
  [[nodiscard]] std::size_t lines() const { return lines_; }
  [[nodiscard]] std::string_view line(std::size_t i) const {
    types::require(i < lines_, "hokuyo::Reply: no such line");
    return {text_.data() + begin_[i], begin_[i + 1] - begin_[i]};
  }

 private:
  friend class ScipParser;
  void start(std::string_view echo);
  void set_status(std::string_view status);
  [[nodiscard]] bool add_line(std::string_view line);  ///< false: no space

  std::array<char, 64> echo_{};
  std::size_t echo_size_ = 0;
  std::array<char, 2> status_{};
  std::size_t status_size_ = 0;
  std::array<char, kMaxText> text_{};
  std::array<std::size_t, kMaxLines + 1> begin_{};
  std::size_t lines_ = 0;
};

/// One scan as received: raw numbers, all check characters correct, exactly as many values as the echo
/// announces. With several echoes per step the first is kept.
struct RawScan {
  StreamRequest echo;
  std::uint32_t time_ms = 0;  ///< 24 bits
  std::size_t points = 0;
  std::array<std::uint32_t, types::Scan::kMaxBeams> range_mm{};
  std::array<std::uint32_t, types::Scan::kMaxBeams> intensity{};
};

/// Parses bytes, split at any position, into replies and scans. Invalid input is dropped up to the next empty
/// line, where every reply ends (PROTOCOLS sections 9 and 13). Fixed storage, no allocation, no clock.
class ScipParser {
 public:
  enum class Event : std::uint8_t {
    kNone,     ///< all bytes were consumed, more are needed
    kReply,    ///< reply() is valid
    kScan,     ///< scan() is valid
    kGarbage,  ///< input was dropped: wrong check character, length or form
  };
  struct Progress {
    std::size_t consumed = 0;
    Event event = Event::kNone;
  };

  /// Takes bytes up to and including the one that completes an event. Invalidates the previous reply() and
  /// scan().
  [[nodiscard]] Progress feed(std::span<const std::byte> bytes);

  /// Returns to the beginning of a reply (after a new connection).
  void reset();

  [[nodiscard]] const Reply& reply() const { return reply_; }
  [[nodiscard]] const RawScan& scan() const { return scan_; }

 private:
  enum class State : std::uint8_t { kEcho, kStatus, kLines, kTime, kData, kSkip };

  [[nodiscard]] Event on_line(std::string_view line);
  [[nodiscard]] Event on_status(std::string_view line);
  [[nodiscard]] Event on_reply_line(std::string_view line);
  [[nodiscard]] Event on_time(std::string_view line);
  [[nodiscard]] Event on_data(std::string_view line);
  [[nodiscard]] Event finish_scan();
  [[nodiscard]] Event drop(std::string_view line);
  [[nodiscard]] bool start_scan();
  [[nodiscard]] bool take_values(std::string_view text);
  [[nodiscard]] bool store_value();

  static constexpr std::size_t kDataWidth = 64;  ///< characters of a full data line (section 9)
  static constexpr std::size_t kMaxLine = 160;   ///< identity lines stay below 80

  State state_ = State::kEcho;
  std::array<char, kMaxLine> line_{};
  std::size_t line_size_ = 0;
  bool overflow_ = false;

  Reply reply_;
  RawScan scan_;
  std::size_t expected_ = 0;     ///< values in the current scan
  std::uint32_t value_ = 0;      ///< current value so far; it may be split over two lines
  std::uint8_t characters_ = 0;  ///< characters of the value so far
  std::uint8_t part_ = 0;        ///< 0: range, 1: intensity
  bool further_echo_ = false;    ///< the value belongs to a second or third echo
  bool last_line_ = false;       ///< a short line was received: only the empty line may follow
};

}  // namespace topo::hokuyo
