// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>

#include "daemon/app/area_book.hpp"
#include "daemon/app/background.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// How far a keyframe moves in the map before drawn areas move with it.
struct AreaMoveParams {
  double by_m = 0.05;  ///< a cell of the map
  double by_rad = 0.01;
};

/// The areas that operators draw: in force at once, given to the team, and kept in a file, which a restart
/// finds. When the map is corrected they stay where they were drawn in the building; those of the
/// configuration are measured from the map's origin, whatever map is the present one. Main only.
class AreaControl {
 public:
  using Announce = std::function<void(const Json& event)>;
  /// `configured`: in force besides. `files`: the thread that writes. `folder`: control.state_folder; empty:
  /// nothing is kept.
  AreaControl(const types::AreaLimits& configured, HandOvers& hand_overs, Background& files,
              const std::string& folder, Announce announce);

  /// Puts those of before into force; to be called before the base's thread starts.
  void start();
  /// As Operations::draw_area and withdraw_area.
  types::Result<std::string> draw(const types::Polygon& corners_map,
                                  types::AreaKind kind = types::AreaKind::kKeepOut);
  types::Status withdraw(const std::string& id);
  /// What the team says of areas, every tick.
  void note(const TeamAreas& team);

  /// The robot's own keyframes of a newer map: own areas move with corrections of it. They stay when another
  /// map is taken, as one of before that goes on: they were drawn in that one.
  void note_map(std::span<const types::KeyframePose> keyframes);

  /// All limits that are in force.
  [[nodiscard]] types::AreaLimits in_force() const { return book_.with(configured_); }
  /// Why no mission may begin: the file cannot be read, so that areas may be missing; empty: none.
  [[nodiscard]] const std::string& obstacle() const { return unread_; }
  /// What is wrong; empty: nothing.
  [[nodiscard]] std::string trouble() const;
  /// As AreaBook::json(), and "kept": whether a restart finds them.
  [[nodiscard]] Json json() const;

 private:
  [[nodiscard]] bool knows_place() const;
  void enforce();
  void keep();
  void tell(const char* what, const DrawnArea& area);

  const types::AreaLimits& configured_;
  HandOvers& hand_overs_;
  Background& files_;
  std::string file_;
  Announce announce_;
  AreaBook book_;
  types::MapAnchors anchors_;  ///< of the own areas
  std::string unread_, unwritten_;
  std::uint64_t writes_ = 0, written_ = 0;
};

}  // namespace topo::daemon
