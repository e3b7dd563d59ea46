// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/session_desk.hpp"

#include <utility>

#include "core/pipeline/mapping_step.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

std::unique_ptr<SessionNews> news_for(const SessionAsk& ask, const pipeline::MappingState& state,
                                      std::uint64_t map) {
  const slam::Mapper& mapper = state.mapper();
  auto made = std::make_unique<SessionNews>();
  SessionNews& news = *made;
  news.number = ask.number;
  news.map = map;
  news.revision = state.revision();
  if (ask.sighting) {
    news.cloud = state.cloud();
    news.T_odom_base = mapper.T_odom_base();
  }
  news.changed = ask.map != map || ask.revision != news.revision;
  if (!news.changed) return made;
  const auto keyframes = mapper.keyframes();
  const auto poses = mapper.poses();
  const auto edges = mapper.edges();
  news.first = ask.map == map && ask.keyframes <= keyframes.size() ? ask.keyframes : 0;
  news.session.keyframes.assign(keyframes.begin() + static_cast<std::ptrdiff_t>(news.first), keyframes.end());
  news.session.poses.assign(poses.begin(), poses.end());
  news.session.edges.assign(edges.begin(), edges.end());
  return made;
}

}  // namespace

std::unique_ptr<const SessionNews> SessionClient::ask(SessionAsk question, types::Duration patience) {
  SessionAsk* slot = desk_.asks.try_acquire();
  if (slot == nullptr) return nullptr;  // the mapping thread has not served the earlier requests
  question.number = ++number_;
  *slot = question;
  desk_.asks.commit();
  mapping_.post();
  const types::Stamp limit = io::monotonic_now() + patience;
  for (types::Stamp now = io::monotonic_now(); now < limit; now = io::monotonic_now()) {
    for (const auto* parcel = desk_.news.front(); parcel != nullptr; parcel = desk_.news.front()) {
      std::unique_ptr<const SessionNews> news = std::move(parcel->content);
      desk_.news.pop();
      if (news->number == number_) return news;  // otherwise a late answer to an earlier request
    }
    desk_.answered.wait(limit - now);
  }
  return nullptr;
}

void serve_desk(SessionDesk& desk, const pipeline::MappingState& state, std::uint64_t map) {
  for (const SessionAsk* ask = desk.asks.front(); ask != nullptr; ask = desk.asks.front()) {
    if (auto* slot = desk.news.try_acquire(); slot != nullptr) {
      slot->content = news_for(*ask, state, map);
      desk.news.commit();
      desk.answered.post();
    }
    desk.asks.pop();
  }
}

}  // namespace topo::daemon
