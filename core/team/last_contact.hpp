// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::team {

/// Where a robot was when it last heard of a mate that is at work, and for how long it has heard of none.
/// What it found meanwhile nobody else knows, and others may be looking at the same.
class LastContact {
 public:
  /// `lost_s`: out of contact for longer is lost; 0: never.
  explicit LastContact(double lost_s = 0.0) : lost_s_(lost_s) {}

  void heard(const types::Vector2& here, types::Stamp now);
  /// It makes no sense to look for the others: they are home, or there were never any.
  void forget() { place_.reset(); }
  /// The robot went there in vain, or could not: not again before it has been lost for as long once more.
  void put_off(types::Stamp now) { since_ = now; }
  /// In map, while contact is lost.
  [[nodiscard]] std::optional<types::Vector2> lost_at(types::Stamp now) const;

 private:
  double lost_s_;
  std::optional<types::Vector2> place_;
  types::Stamp since_{};
};

}  // namespace topo::team
