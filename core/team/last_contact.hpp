// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/types/map_correction.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::team {

/// The robot's position at its last contact with a working team-mate, and the time since. What the robot has
/// found since then is unknown to the team, and team-mates may be exploring the same area.
class LastContact {
 public:
  /// `lost_s`: contact counts as lost after this time; 0: never.
  explicit LastContact(double lost_s = 0.0) : lost_s_(lost_s) {}

  void heard(const types::Vector2& here, types::Stamp now);
  /// To be called when a search for team-mates is pointless: all are home, or there were never any.
  void forget() { place_.reset(); }
  /// Defers the return to the place of contact, after an attempt that failed or was not possible: contact
  /// must be lost for `lost_s` once more, and after every further attempt for twice as long as before it. A
  /// team-mate whose radio has failed costs a share of the mission that falls, and not a fixed one.
  void put_off(types::Stamp now);
  /// The map was corrected.
  void move(const types::MapCorrection& correction) {
    if (place_) place_ = correction(*place_);
  }
  /// In map; only while contact is lost.
  [[nodiscard]] std::optional<types::Vector2> lost_at(types::Stamp now) const;

 private:
  double lost_s_;
  std::optional<types::Vector2> place_;
  types::Stamp since_{};
  int put_off_ = 0;  ///< how often, since the last contact
};

}  // namespace topo::team
