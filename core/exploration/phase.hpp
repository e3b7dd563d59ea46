// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "core/exploration/mission.hpp"
#include "core/grid/dense_map.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

// The robot's present activity. A phase is a value; next() is the only function that changes it.
namespace topo::exploration {

struct Idle {
  friend bool operator==(const Idle&, const Idle&) = default;
};
struct Exploring {
  friend bool operator==(const Exploring&, const Exploring&) = default;
};
/// An exploration that returns to the place where a team-mate was last heard.
struct SeekingContact {
  friend bool operator==(const SeekingContact&, const SeekingContact&) = default;
};
struct Returning {
  std::string why;
  bool cut_short = false;  ///< by the battery: being home does not complete the order
  friend bool operator==(const Returning&, const Returning&) = default;
};
/// At home, while team-mates are still out.
struct WaitingAtHome {
  Returning way;
  friend bool operator==(const WaitingAtHome&, const WaitingAtHome&) = default;
};
struct GoingTo {
  friend bool operator==(const GoingTo&, const GoingTo&) = default;
};

/// The robot's activity for a mission.
using Task = std::variant<Exploring, SeekingContact, Returning, WaitingAtHome, GoingTo>;

/// A team-mate that cannot pass this robot.
struct Passage {
  std::uint16_t mate = 0;
  types::Vector2 asked_at{0.0, 0.0};  ///< position of this robot at that time
  types::Stamp since{};
  grid::CellIndex target;  ///< of this robot, before and after standing aside
};
/// Stands aside for a team-mate; the task continues afterwards.
struct MakingWay {
  Passage passage;
  Task task;
};

/// A task, or the interruption of one.
using Active = std::variant<Exploring, SeekingContact, Returning, WaitingAtHome, GoingTo, MakingWay>;

struct Paused {
  Active before;
};
struct Done {
  friend bool operator==(const Done&, const Done&) = default;
};
struct Failed {
  friend bool operator==(const Failed&, const Failed&) = default;
};

using Phase = std::variant<Idle, Exploring, SeekingContact, Returning, WaitingAtHome, GoingTo, MakingWay,
                           Paused, Done, Failed>;

namespace event {

struct Ordered {  ///< a new mission
  Order order = Order::kStand;
};
struct PauseOrdered {};
struct ResumeOrdered {};
struct BatteryLow {};
struct GoalsExhausted {      ///< no goal is left in reach, also for coordinated team-mates
  std::size_t left_out = 0;  ///< goals in reach that are not worth their time
};
struct GoalFound {};  ///< a goal that justifies turning round on the way home
struct ContactLost {};
struct ContactEnded {};  ///< a team-mate is heard again, or the search for one has failed
struct RightOfWay {      ///< a team-mate needs to pass
  Passage passage;
};
struct Passed {};     ///< it has passed, or standing aside did not help
struct Arrived {};    ///< at the target; at home when the robot need not wait for team-mates
struct MatesOut {};   ///< at home, and team-mates are not
struct Rechecked {};  ///< a decision begins: whether the robot is still at home is tested again
struct NoProgress {};

}  // namespace event

using Event = std::variant<event::Ordered, event::PauseOrdered, event::ResumeOrdered, event::BatteryLow,
                           event::GoalsExhausted, event::GoalFound, event::ContactLost, event::ContactEnded,
                           event::RightOfWay, event::Passed, event::Arrived, event::MatesOut,
                           event::Rechecked, event::NoProgress>;

/// The phase after an event. An event that does not concern the present phase has no effect.
Phase next(Phase phase, const Event& event);

/// True when the mission needs no further action.
bool has_ended(const Phase& phase);
/// True on the way home and at home, also while the robot stands aside or is paused.
bool is_homing(const Phase& phase);
/// True while the robot waits at home, also when it is paused there.
bool is_waiting_at_home(const Phase& phase);
/// True during a search for contact, also while the robot stands aside or is paused.
bool is_seeking_contact(const Phase& phase);

}  // namespace topo::exploration
