// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/types/se2.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// A session in which the operator is to say where the robot is.
struct PlaceOffer {
  std::string name, path;                ///< of the session
  std::optional<types::Se2> T_map_base;  ///< proposed; nothing: the operator has to give the pose
};

/// Where the robot is in a session that goes on: sought, proposed, on trial in the first metres, dropped.
/// Tells the base whether the place counts, and the journal whether the map may be written. Main only.
class PlaceWatch {
 public:
  /// A plan made in the map before counts for so long: pipeline::ControlSetup::plan_age_max.
  static constexpr types::Duration kPlanAge = std::chrono::seconds(1);

  explicit PlaceWatch(HandOvers& hand_overs) : hand_overs_(hand_overs) {}

  /// The robot's place is unknown until further notice: by hand it may be driven where no areas are limited.
  /// `is_trouble`: for an operator to see to. `offer`: a session for which a pose can be given.
  void seek(std::string why, bool is_trouble, std::optional<PlaceOffer> offer = {});
  /// The robot stands until the operator confirms. `place`: one sentence, as slam::describe() has it.
  void propose(PlaceOffer offer, const std::string& place);
  /// The session is the map now, as the mapper's map of this number: its first metres are on trial.
  void take(PlaceOffer session, std::uint64_t map, types::Stamp now);
  /// The map is the robot's own, made since the start.
  void own();
  /// A map of its own is to be begun, because the present one is on trial, or was dropped.
  void begin_anew();
  /// A map of its own was begun.
  void fresh_map_made();
  /// To be called every tick. True once, when a place was dropped.
  bool note(const MappingReport& report, types::Stamp now);

  [[nodiscard]] const std::string& obstacle() const { return obstacle_; }  ///< to missions; empty: none
  [[nodiscard]] std::string trouble() const { return is_trouble_ ? obstacle_ : std::string(); }
  /// The session that waits for the operator; nothing: none does.
  [[nodiscard]] std::optional<PlaceOffer> waiting() const { return is_trouble_ ? offer_ : std::nullopt; }
  [[nodiscard]] types::PlaceStanding standing() const;
  /// True while what is added to the session's map may be at a wrong place.
  [[nodiscard]] bool on_trial() const { return trial_map_ > 0; }
  [[nodiscard]] bool wants_fresh_map() const { return wants_fresh_map_; }
  [[nodiscard]] bool dropped_before() const { return dropped_before_; }
  [[nodiscard]] Json json() const;

 private:
  void stand(types::PlaceStanding standing);
  void drop();

  HandOvers& hand_overs_;
  std::string obstacle_;
  bool is_trouble_ = false;
  std::optional<PlaceOffer> offer_;  ///< proposed, on trial, or dropped
  std::uint64_t trial_map_ = 0;      ///< number of the map that is on trial; 0: none
  slam::TrialCount trial_;           ///< the newest
  bool wants_fresh_map_ = false;
  bool anew_ = false;                       ///< the fresh map is the operator's wish
  bool dropped_before_ = false;             ///< since the start or the last map of its own
  std::optional<types::Stamp> known_from_;  ///< when no plan is left from the map before
};

/// One word for tables and JSON.
[[nodiscard]] std::string_view to_text(types::PlaceStanding standing);

}  // namespace topo::daemon
