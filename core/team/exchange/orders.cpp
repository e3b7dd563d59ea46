// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/orders.hpp"

#include <algorithm>

namespace topo::team {
namespace {

/// Orders that are repeated at once; with more, the oldest gives way. An operator gives one or two.
constexpr std::size_t kUrgentMax = 8;

}  // namespace

bool Orders::repeat(const EntryId& id, types::Duration age, types::Stamp now,
                    std::optional<std::uint16_t> to) {
  if (is_urgent(id)) return false;
  if (urgent_.size() >= kUrgentMax) urgent_.erase(urgent_.begin());
  urgent_.push_back({id, now, age, Periodic(seed_ + id.sequence), to});
  return true;
}

void Orders::expire(const PeriodParams& periods, types::Stamp now) {
  std::erase_if(urgent_, [&](const UrgentOrder& order) {
    return now - order.since + order.age > types::from_seconds(periods.order_repeat_s);
  });
}

bool Orders::is_urgent(const EntryId& id) const {
  return std::any_of(urgent_.begin(), urgent_.end(),
                     [&](const UrgentOrder& order) { return order.id == id; });
}

void Orders::note(const Acknowledgement& body, const EntryId& entry) {
  acknowledged_[body.order].emplace(entry.robot, Word{entry, body.refused});
}

bool Orders::has_acknowledged(std::uint16_t robot, const EntryId& order) const {
  const auto at = acknowledged_.find(order);
  return at != acknowledged_.end() && at->second.contains(robot);
}

std::vector<std::uint16_t> Orders::acknowledged_by(const EntryId& order) const {
  std::vector<std::uint16_t> robots;
  if (const auto at = acknowledged_.find(order); at != acknowledged_.end()) {
    for (const auto& [robot, word] : at->second)
      if (word.refused.empty()) robots.push_back(robot);
  }
  return robots;
}

std::map<std::uint16_t, std::string> Orders::refused_by(const EntryId& order) const {
  std::map<std::uint16_t, std::string> robots;
  if (const auto at = acknowledged_.find(order); at != acknowledged_.end()) {
    for (const auto& [robot, word] : at->second)
      if (!word.refused.empty()) robots.emplace(robot, word.refused);
  }
  return robots;
}

void Orders::send_acknowledgement(std::uint16_t robot, const EntryId& order) {
  const auto at = acknowledged_.find(order);
  if (at == acknowledged_.end()) return;
  if (const auto entry = at->second.find(robot); entry != at->second.end())
    to_send_.insert(entry->second.entry);
}

}  // namespace topo::team
