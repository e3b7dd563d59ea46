// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/seats.hpp"

#include <algorithm>

namespace topo::daemon {
namespace {

template <class Belongs>
std::optional<std::size_t> oldest(std::span<const Standing> clients, Belongs belongs) {
  const auto found = std::find_if(clients.begin(), clients.end(), belongs);
  if (found == clients.end()) return {};
  return static_cast<std::size_t>(found - clients.begin());
}

template <class Belongs>
std::size_t count(std::span<const Standing> clients, Belongs belongs) {
  return static_cast<std::size_t>(std::count_if(clients.begin(), clients.end(), belongs));
}

}  // namespace

std::optional<std::size_t> who_leaves(std::span<const Standing> clients, const Standing& newcomer,
                                      const Seats& seats) {
  const auto commands = [](const Standing& s) { return s.may_command; };
  const auto looks = [](const Standing& s) { return !s.may_command; };
  const auto of = [](uid_t user) {
    return [user](const Standing& s) { return !s.may_command && s.user == user; };
  };
  if (newcomer.may_command)
    return count(clients, commands) < seats.commanding ? std::nullopt : oldest(clients, commands);
  if (count(clients, of(newcomer.user)) >= seats.of_one_other) return oldest(clients, of(newcomer.user));
  if (count(clients, looks) < seats.others) return {};
  std::size_t most = 0;
  for (const Standing& client : clients) {
    if (looks(client)) most = std::max(most, count(clients, of(client.user)));
  }
  return oldest(clients, [&](const Standing& s) { return looks(s) && count(clients, of(s.user)) == most; });
}

}  // namespace topo::daemon
