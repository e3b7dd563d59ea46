// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "core/exploration/mission.hpp"
#include "core/grid/dense_map.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

// What the robot is about. A phase is a value; next() is the only function that leads from one to another.
namespace topo::exploration {

struct Idle {
  friend bool operator==(const Idle&, const Idle&) = default;
};
struct Exploring {
  friend bool operator==(const Exploring&, const Exploring&) = default;
};
/// An exploration that goes back to where a team-mate was last heard.
struct SeekingContact {
  friend bool operator==(const SeekingContact&, const SeekingContact&) = default;
};
struct Returning {
  std::string why;
  bool cut_short = false;  ///< by the battery: being home does not fulfil what was ordered
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

/// What a robot does for a mission.
using Task = std::variant<Exploring, SeekingContact, Returning, WaitingAtHome, GoingTo>;

/// A team-mate that cannot pass.
struct Passage {
  std::uint16_t mate = 0;
  types::Vector2 asked_at{0.0, 0.0};  ///< where this robot was
  types::Stamp since{};
  grid::CellIndex target;  ///< where this robot was bound for, and is again afterwards
};
/// Stands aside for a team-mate; the task goes on afterwards.
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
struct GoalsExhausted {};  ///< no goal is left in reach, for any robot
struct GoalFound {};       ///< one that is worth turning round for on the way home
struct ContactLost {};
struct ContactEnded {};  ///< a team-mate is heard again, or the search for one was in vain
struct RightOfWay {      ///< a team-mate has to pass
  Passage passage;
};
struct Passed {};     ///< it has passed, or standing aside did not help
struct Arrived {};    ///< at the target; at home when no team-mate is waited for
struct MatesOut {};   ///< at home, and team-mates are not
struct Rechecked {};  ///< a decision begins: whether the robot is still at home is found out anew
struct NoProgress {};

}  // namespace event

using Event = std::variant<event::Ordered, event::PauseOrdered, event::ResumeOrdered, event::BatteryLow,
                           event::GoalsExhausted, event::GoalFound, event::ContactLost, event::ContactEnded,
                           event::RightOfWay, event::Passed, event::Arrived, event::MatesOut,
                           event::Rechecked, event::NoProgress>;

/// The phase after an event. One that does not concern the present phase leaves it as it is.
Phase next(Phase phase, const Event& event);

/// True when nothing is left to be done for the mission.
bool has_ended(const Phase& phase);
/// True on the way home and at home, also while the robot stands aside or is paused.
bool is_homing(const Phase& phase);
/// True while the robot waits at home, also when it is paused there.
bool is_waiting_at_home(const Phase& phase);
/// True during a search for contact, also while the robot stands aside or is paused.
bool is_seeking_contact(const Phase& phase);

}  // namespace topo::exploration
