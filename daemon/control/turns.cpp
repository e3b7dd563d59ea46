// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/turns.hpp"

#include <algorithm>
#include <utility>

namespace topo::daemon {

void Turns::join(std::uint64_t client, const Standing& standing) {
  clients_.push_back({client, standing, false, {}, {}});
}

void Turns::leave(std::uint64_t client) {
  const auto found = find(client);
  if (found == clients_.end()) return;
  found->left = true;
  if (!found->standing.may_command) found->others.clear();  // questions, and nobody to be answered
  if (found->stops.empty() && found->others.empty()) clients_.erase(found);
}

void Turns::add(std::uint64_t client, std::string line, bool estop) {
  const auto found = find(client);
  if (found == clients_.end()) return;
  (estop ? found->stops : found->others).push_back({std::move(line), stops_served_});
}

std::size_t Turns::waiting(std::uint64_t client) const {
  const auto found = std::find_if(clients_.begin(), clients_.end(),
                                  [client](const Client& c) { return c.number == client; });
  return found == clients_.end() ? 0 : found->stops.size() + found->others.size();
}

std::optional<Turns::Turn> Turns::next(types::Stamp now) {
  const auto stop = first_stop();
  const auto other = stop == clients_.end() || owes_other_ ? first_other(now) : clients_.end();
  if (other != clients_.end()) {
    owes_other_ = false;
    if (!other->standing.may_command) {
      static_cast<void>(requests_.take(other->standing.user, now));  // first_other() has looked
      ++unanswered_;
    }
    return take(other, other->others);
  }
  if (stop == clients_.end()) return {};
  owes_other_ = true;
  if (!stop->standing.may_command) ++unanswered_;
  Turn turn = take(stop, stop->stops);
  ++stops_served_;
  return turn;
}

std::optional<types::Stamp> Turns::next_at(types::Stamp now) const {
  std::optional<types::Stamp> earliest;
  for (const Client& client : clients_) {
    const bool at_once = !client.stops.empty() || (!client.others.empty() && client.standing.may_command);
    if (at_once) return now;
    if (client.others.empty() || unanswered_ >= unanswered_max_) continue;
    const types::Stamp at = requests_.next_at(client.standing.user, now);
    earliest = std::min(earliest.value_or(at), at);
  }
  return earliest;
}

void Turns::answered(bool may_command) {
  if (!may_command) --unanswered_;
}

Turns::Clients::iterator Turns::find(std::uint64_t client) {
  return std::find_if(clients_.begin(), clients_.end(),
                      [client](const Client& c) { return c.number == client && !c.left; });
}

Turns::Clients::iterator Turns::first_stop() {
  return std::find_if(clients_.begin(), clients_.end(), [](const Client& c) { return !c.stops.empty(); });
}

Turns::Clients::iterator Turns::first_other(types::Stamp now) {
  const auto commander = std::find_if(clients_.begin(), clients_.end(), [](const Client& c) {
    return !c.others.empty() && c.standing.may_command;
  });
  if (commander != clients_.end() || unanswered_ >= unanswered_max_) return commander;
  return std::find_if(clients_.begin(), clients_.end(), [this, now](const Client& c) {
    return !c.others.empty() && requests_.next_at(c.standing.user, now) <= now;
  });
}

Turns::Turn Turns::take(Clients::iterator client, std::deque<Queued>& queue) {
  Queued& first = queue.front();
  Turn turn{client->number, client->standing, std::move(first.line), first.stops_before < stops_served_};
  queue.pop_front();
  clients_.splice(clients_.end(), clients_, client);
  if (client->left && client->stops.empty() && client->others.empty()) clients_.erase(client);
  return turn;
}

}  // namespace topo::daemon
