// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/peers.hpp"

#include <algorithm>

#include "core/team/exchange/wire.hpp"

namespace topo::team {

bool is_alive(const Peer& peer, const PeriodParams& periods, types::Stamp now) {
  return now - peer.heard <= types::from_seconds(periods.alive_s);
}

bool hears_us(const Peer& peer, const PeriodParams& periods, types::Stamp now) {
  return is_alive(peer, periods, now) && peer.heard_us &&
         now - *peer.heard_us <= types::from_seconds(periods.alive_s);
}

bool is_newer(std::optional<std::uint32_t>& newest, std::uint32_t counter) {
  if (newest && !is_later(counter, *newest)) return false;
  newest = counter;
  return true;
}

Hearing Peers::hear(const slam::Origin& sender, std::uint32_t counter, const ExchangeParams& params,
                    types::Stamp now) {
  auto at = peers_.find(sender);
  if (at == peers_.end()) {
    forget(params.periods, now);
    if (peers_.size() >= params.caps.peers) return Hearing::kTooMany;
    at = peers_.emplace(sender, Peer{}).first;
    at->second.first = now;
    at->second.newest = counter;
  }
  Peer& peer = at->second;
  if (is_later(counter, peer.newest)) {
    peer.window <<= std::min<std::size_t>(counter - peer.newest, peer.window.size());
    peer.newest = counter;
  }
  const std::uint32_t age = peer.newest - counter;
  if (age >= peer.window.size() || peer.window.test(age)) return Hearing::kRepeated;
  peer.window.set(age);
  peer.heard = now;
  peer.link.note_datagram(counter);
  return Hearing::kFresh;
}

Peer* Peers::find(const slam::Origin& origin) {
  const auto at = peers_.find(origin);
  return at == peers_.end() ? nullptr : &at->second;
}

void Peers::forget(const PeriodParams& periods, types::Stamp now) {
  std::erase_if(peers_, [&](const auto& entry) {
    return now - entry.second.heard > types::from_seconds(periods.forget_s);
  });
}

bool Peers::is_double(std::uint16_t robot, const slam::Origin& self, const PeriodParams& periods,
                      types::Stamp now) const {
  // Nearly always there is one run, and nothing to look for.
  const auto first = peers_.lower_bound({robot, 0});
  const bool has_two =
      first != peers_.end() && first->first.robot == robot &&
      (robot == self.robot || (std::next(first) != peers_.end() && std::next(first)->first.robot == robot));
  if (!has_two) return false;
  const std::vector<DuplicateId> found = duplicates(self, periods, now);
  return std::ranges::any_of(found, [&](const DuplicateId& id) { return id.robot == robot; });
}

std::vector<DuplicateId> Peers::duplicates(const slam::Origin& self, const PeriodParams& periods,
                                           types::Stamp now) const {
  const types::Duration overlap = types::from_seconds(periods.overlap_s);
  std::vector<DuplicateId> found;
  for (auto a = peers_.begin(); a != peers_.end(); ++a) {
    if (!is_alive(a->second, periods, now)) continue;
    // What this robot sent before its own restart may still arrive, but not for so long.
    if (a->first.robot == self.robot && a->second.heard - a->second.first > overlap)
      found.push_back({self.robot, self.run, a->first.run, true});
    for (auto b = std::next(a); b != peers_.end() && b->first.robot == a->first.robot; ++b) {
      const types::Stamp begin = std::max(a->second.first, b->second.first),
                         end = std::min(a->second.heard, b->second.heard);
      if (is_alive(b->second, periods, now) && end - begin > overlap)
        found.push_back({a->first.robot, a->first.run, b->first.run, false});
    }
  }
  return found;
}

std::vector<slam::Origin> Peers::listed(const slam::Origin& self, const PeriodParams& periods,
                                        types::Stamp now) const {
  const std::vector<DuplicateId> doubled = duplicates(self, periods, now);
  std::map<std::uint16_t, Map::const_iterator> newest;
  for (auto at = peers_.begin(); at != peers_.end(); ++at) {
    const auto [known, added] = newest.try_emplace(at->first.robot, at);
    if (!added && at->second.heard > known->second->second.heard) known->second = at;
  }
  std::vector<slam::Origin> runs;
  for (auto at = peers_.begin(); at != peers_.end(); ++at) {
    const slam::Origin& peer = at->first;
    const bool is_doubled = std::ranges::any_of(doubled, [&](const DuplicateId& id) {
      return id.robot == peer.robot && (id.run_a == peer.run || id.run_b == peer.run);
    });
    const bool is_newest = peer.robot != self.robot && newest.at(peer.robot) == at;
    if ((is_doubled || is_newest) && now - at->second.heard <= types::from_seconds(periods.forget_s))
      runs.push_back(peer);
  }
  return runs;
}

}  // namespace topo::team
