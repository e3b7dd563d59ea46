// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/types/stamp.hpp"

namespace topo::team {

/// Bytes that may be sent: they come at a rate and are saved up to a bound, so that contact after a long time
/// is no burst. Value semantics.
class ByteBudget {
 public:
  /// To be called before the rest: adds what has come since the last call, at most `burst_bytes` in all.
  void refill(double rate_bytes_per_s, double burst_bytes, types::Stamp now);
  /// True when so much may be sent.
  [[nodiscard]] bool allows(double bytes) const { return bytes_ >= bytes; }
  /// May go below zero: what is urgent is sent at once and saved afterwards.
  void spend(double bytes) { bytes_ -= bytes; }
  [[nodiscard]] double bytes() const { return bytes_; }

 private:
  double bytes_ = 0.0;
  types::Stamp last_{};
  bool begun_ = false;
};

/// Something that is due once in a period that varies by a share of it; the same seed varies alike.
class Periodic {
 public:
  explicit Periodic(std::uint64_t seed = 0) : state_(seed) {}
  [[nodiscard]] bool is_due(types::Stamp now) const { return now >= next_; }
  /// It was done; next in a period.
  void done(types::Stamp now, double period_s, double jitter);
  /// No later than then.
  void hasten(types::Stamp at) { next_ = at < next_ ? at : next_; }

 private:
  std::uint64_t state_;
  types::Stamp next_{};
};

}  // namespace topo::team
