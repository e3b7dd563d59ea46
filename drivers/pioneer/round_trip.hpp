// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/types/stamp.hpp"

namespace topo::pioneer {

/// Time from a request to the base's answer: the only measurement of how long commands wait on their line
/// while the command does not change. The request is ENCODER 1, which is answered by one ENCODERpac
/// (PROTOCOLS section 3).
///
/// Answers carry no number: the next request waits until the last one is answered or lost, so that a late
/// answer is known to be one. A base that never answered is not asked for ever.
///
/// What is measured is the shortest time that the trip may have taken: from when the request had left this
/// host, until when the answer may have come, which is when this host last looked and found none. A host that
/// was late by itself sees nothing late of the base. Sans-I/O; time is passed as stamps.
class RoundTrip {
 public:
  static constexpr types::Duration kEvery = std::chrono::milliseconds(500);
  static constexpr types::Duration kLost = std::chrono::seconds(3);
  static constexpr int kLostInARow = 3;  ///< by chance hardly: the line or the base is dead for requests

  [[nodiscard]] bool is_due(types::Stamp now) const {
    return !open_since_ && now - last_ >= kEvery && (answers_ || lost_ < kLostInARow);
  }
  /// The request waits to be sent.
  void asked(types::Stamp now) { last_ = now, open_since_ = now; }
  /// It has left this host; without effect when none is open.
  void left(types::Stamp sent) {
    if (open_since_) open_since_ = std::max(*open_since_, sent);
  }
  /// `earliest`: not before it the answer arrived.
  void answered(types::Stamp earliest) {
    if (!open_since_) return;  // of a request that was given up
    answers_ = true;
    lost_ = 0;
    trip_ = std::max(earliest - *open_since_, kShortest);
    open_since_.reset();
  }
  /// To be called regularly: gives up a request that is lost. `now`: until when the answers were looked for.
  void expire(types::Stamp now) {
    if (!open_since_ || now - *open_since_ <= kLost) return;
    open_since_.reset();
    lost_ = std::min(lost_ + 1, kLostInARow);
    if (answers_ && lost_ == kLostInARow) trip_ = kLost;
  }

  /// Of the newest answer; kLost when three requests in a row had none; 0 when the base never answered.
  [[nodiscard]] types::Duration trip() const { return trip_; }

 private:
  static constexpr types::Duration kShortest{1};  ///< 0 is a base that never answered
  std::optional<types::Stamp> open_since_;
  types::Stamp last_{};
  bool answers_ = false;
  int lost_ = 0;  ///< in a row
  types::Duration trip_{};
};

}  // namespace topo::pioneer
