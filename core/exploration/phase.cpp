// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/phase.hpp"

#include <type_traits>
#include <utility>

namespace topo::exploration {
namespace {

/// A visitor built from lambdas.
template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

/// The same alternative in a variant that has more of them.
template <class Wider, class Narrower>
Wider widened(Narrower narrower) {
  return std::visit([](auto alternative) -> Wider { return alternative; }, std::move(narrower));
}

std::string explored(std::size_t left_out) {
  if (left_out == 0) return "explored: no goal is left in reach";
  return "explored: goals that are not worth their time are left out: " + std::to_string(left_out);
}

Phase ordered(Order order) {
  switch (order) {
    case Order::kStand:
      return Idle{};
    case Order::kExplore:
      return Exploring{};
    case Order::kHome:
      return Returning{"on the operator's order", false};
    case Order::kGoTo:
      return GoingTo{};
  }
  return Idle{};
}

/// A low battery leads an exploring or travelling robot home; other phases stay.
template <class Here>
Phase on_low_battery(Here here) {
  if constexpr (std::is_same_v<Here, Exploring> || std::is_same_v<Here, SeekingContact> ||
                std::is_same_v<Here, GoingTo>)
    return Returning{"the battery is low", true};
  else
    return here;
}

Phase arrived(const Phase& phase) {
  if (std::holds_alternative<GoingTo>(phase)) return Done{};
  const Returning* way = std::get_if<Returning>(&phase);
  if (const auto* waiting = std::get_if<WaitingAtHome>(&phase)) way = &waiting->way;
  if (way == nullptr) return phase;
  if (way->cut_short) return Failed{};
  return Done{};
}

Phase paused(Phase phase) {
  return std::visit(
      [](auto here) -> Phase {
        using Here = std::decay_t<decltype(here)>;
        if constexpr (std::is_constructible_v<Active, Here>)
          return Paused{Active(std::move(here))};
        else
          return here;
      },
      std::move(phase));
}

Phase stands_aside(Phase phase, const Passage& passage) {
  return std::visit(
      [&](auto here) -> Phase {
        using Here = std::decay_t<decltype(here)>;
        if constexpr (std::is_constructible_v<Task, Here>)
          return MakingWay{passage, Task(std::move(here))};
        else
          return here;
      },
      std::move(phase));
}

}  // namespace

Phase next(Phase phase, const Event& event) {
  return std::visit(
      Overloaded{
          [&](const event::Ordered& e) { return ordered(e.order); },
          [&](const event::PauseOrdered&) { return paused(std::move(phase)); },
          [&](const event::ResumeOrdered&) {
            auto* here = std::get_if<Paused>(&phase);
            return here != nullptr ? widened<Phase>(std::move(here->before)) : std::move(phase);
          },
          [&](const event::BatteryLow&) {
            return std::visit([](auto here) -> Phase { return on_low_battery(std::move(here)); },
                              std::move(phase));
          },
          [&](const event::GoalsExhausted& e) {
            if (!std::holds_alternative<Exploring>(phase)) return std::move(phase);
            return Phase(Returning{explored(e.left_out), false});
          },
          [&](const event::GoalFound&) {
            return is_homing(phase) && !std::holds_alternative<MakingWay>(phase) &&
                           !std::holds_alternative<Paused>(phase)
                       ? Phase(Exploring{})
                       : std::move(phase);
          },
          [&](const event::ContactLost&) {
            return std::holds_alternative<Exploring>(phase) ? Phase(SeekingContact{}) : std::move(phase);
          },
          [&](const event::ContactEnded&) {
            return std::holds_alternative<SeekingContact>(phase) ? Phase(Exploring{}) : std::move(phase);
          },
          [&](const event::RightOfWay& e) { return stands_aside(std::move(phase), e.passage); },
          [&](const event::Passed&) {
            auto* here = std::get_if<MakingWay>(&phase);
            return here != nullptr ? widened<Phase>(std::move(here->task)) : std::move(phase);
          },
          [&](const event::Arrived&) { return arrived(phase); },
          [&](const event::MatesOut&) {
            auto* way = std::get_if<Returning>(&phase);
            return way != nullptr ? Phase(WaitingAtHome{std::move(*way)}) : std::move(phase);
          },
          [&](const event::Rechecked&) {
            auto* waiting = std::get_if<WaitingAtHome>(&phase);
            return waiting != nullptr ? Phase(std::move(waiting->way)) : std::move(phase);
          },
          [&](const event::NoProgress&) {
            return std::holds_alternative<Returning>(phase) || std::holds_alternative<WaitingAtHome>(phase) ||
                           std::holds_alternative<GoingTo>(phase)
                       ? Phase(Failed{})
                       : std::move(phase);
          },
      },
      event);
}

bool has_ended(const Phase& phase) {
  return std::holds_alternative<Idle>(phase) || std::holds_alternative<Done>(phase) ||
         std::holds_alternative<Failed>(phase);
}

bool is_homing(const Phase& phase) {
  if (const auto* aside = std::get_if<MakingWay>(&phase)) return is_homing(widened<Phase>(aside->task));
  if (const auto* paused = std::get_if<Paused>(&phase)) return is_homing(widened<Phase>(paused->before));
  return std::holds_alternative<Returning>(phase) || std::holds_alternative<WaitingAtHome>(phase);
}

bool is_waiting_at_home(const Phase& phase) {
  if (const auto* paused = std::get_if<Paused>(&phase))
    return std::holds_alternative<WaitingAtHome>(paused->before);
  return std::holds_alternative<WaitingAtHome>(phase);
}

bool is_seeking_contact(const Phase& phase) {
  if (const auto* aside = std::get_if<MakingWay>(&phase))
    return std::holds_alternative<SeekingContact>(aside->task);
  if (const auto* paused = std::get_if<Paused>(&phase))
    return is_seeking_contact(widened<Phase>(paused->before));
  return std::holds_alternative<SeekingContact>(phase);
}

}  // namespace topo::exploration
