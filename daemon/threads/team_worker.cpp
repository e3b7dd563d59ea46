// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/team_worker.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "core/team/mates_frame.hpp"
#include "daemon/logging/event_catalogue.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// The exchange is asked for datagrams at least so often (RateParams::burst_s covers two).
constexpr types::Duration kTurn = std::chrono::milliseconds(50);
/// Mapping is asked so often: a keyframe comes every 0.6 s at most.
constexpr types::Duration kAskPeriod = std::chrono::milliseconds(200);
constexpr types::Duration kReportPeriod = std::chrono::milliseconds(250);
/// The socket's folder may appear later than the daemon.
constexpr types::Duration kListenAgain = std::chrono::seconds(5);
/// Mates not heard for so long are no longer shown to planning; the roster judges those that are.
constexpr types::Duration kForget = std::chrono::minutes(30);

/// They are news again every PeriodParams::alive_s while they last.
constexpr types::Duration kDuplicatesLast = std::chrono::seconds(7);
/// A robot whose journal is not read by then joins its team without: it has to hear an order to stop.
constexpr types::Duration kJournalPatience = std::chrono::seconds(20);

/// What is new, and the next of what is late, at most `most` of that.
template <class T>
std::vector<T> with_late(std::vector<T> now, std::vector<T>& late, std::size_t most) {
  const auto end = late.begin() + static_cast<std::ptrdiff_t>(std::min(most, late.size()));
  now.insert(now.end(), std::move_iterator(late.begin()), std::move_iterator(end));
  late.erase(late.begin(), end);
  return now;
}

}  // namespace

void TeamWorker::run() noexcept {
  types::Stamp next_listen{};
  while (!hand_overs_.ending.stopping.load(std::memory_order_acquire)) {
    std::array<pollfd, 2> fds{
        {{hand_overs_.team.wakeup.fd(), POLLIN, 0}, {link_ ? link_->fd() : -1, POLLIN, 0}}};
    ::poll(fds.data(), fds.size(),
           static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(kTurn).count()));
    (void)hand_overs_.team.wakeup.wait(types::Duration::zero());
    vitals_.beat();
    const types::Stamp now = io::monotonic_now();
    if (!link_ && now >= next_listen) {
      next_listen = now + kListenAgain;
      listen();
    }
    turn(now);
    vitals_.run.record((io::monotonic_now() - now).count());
  }
}

/// What the journal holds of the team is held from the first datagram on, so that no mate sends it again; it
/// is news to the map that was begun at the start.
void TeamWorker::take_journalled(types::Stamp now) {
  if (!awaits_journal_) return;
  if (!journal_limit_) journal_limit_ = now + kJournalPatience;
  if (now > *journal_limit_) awaits_journal_ = false;
  const auto* parcel = hand_overs_.team.journalled.front();
  if (parcel == nullptr) return;
  late_keyframes_ = std::move(parcel->content->keyframes);
  late_relations_ = std::move(parcel->content->relations);
  own_.goes_on = !late_keyframes_.empty();
  hand_overs_.team.journalled.pop();
  awaits_journal_ = false;
}

void TeamWorker::listen() {
  auto socket = LinkSocket::listen(settings_.socket, {team_hash(settings_.name), settings_.robot});
  if (!socket) return warn(io::monotonic_now(), socket.error().message);
  link_.emplace(std::move(*socket));
}

void TeamWorker::warn(types::Stamp now, const std::string& words) {
  if (std::exchange(report_.words, words) == words) return;
  post(vitals_.events, now.time_since_epoch().count(), EventId::kTeam, sync::Severity::kWarning, {}, words);
}

void TeamWorker::turn(types::Stamp now) {
  take_journalled(now);
  take_own(now);
  if (link_) {
    const auto changed = link_->turn(now, [&](std::uint16_t sender, std::span<const std::byte> datagram) {
      if (exchange_) exchange_->take(datagram, now, sender);
    });
    if (changed) {
      const bool joined = changed->kind == LinkNews::Kind::kJoined;
      report_.words = joined ? std::string() : changed->words;
      post(vitals_.events, now.time_since_epoch().count(), EventId::kTeam,
           joined ? sync::Severity::kInfo : sync::Severity::kWarning, {}, changed->words);
    }
  }
  if (exchange_) {
    take_requests(now);
    take_news(now);
    for (const team::Datagram& datagram : exchange_->datagrams(now))
      if (link_) link_->send(datagram);
  }
  ask_mapping(now);
  if (now >= next_report_) report(now);
}

/// A map that was taken over goes on under a run of its own: the exchange begins anew with it and holds what
/// the map holds.
void TeamWorker::begin_map(const OwnMapNews& news) {
  const std::optional<team::Exchange> before = std::exchange(exchange_, std::nullopt);
  team::ExchangeParams params = settings_.exchange;
  params.periods.seed = (std::uint64_t{news.origin.run} << 16U) + news.origin.robot;
  exchange_.emplace(
      team::ExchangeIdentity{team::team_hash(settings_.name), news.origin.robot, news.origin.run}, params);
  const auto restore = [&](const types::Status& kept) {
    if (!kept) warn(io::monotonic_now(), kept.error().message);
  };
  std::set<slam::KeyframeId> held;
  for (const slam::KeyframePtr& keyframe : news.held) {
    restore(exchange_->restore_keyframe(*keyframe));
    held.insert(keyframe->id);
  }
  for (const slam::FoundRelation& found : news.held_relations) restore(exchange_->restore_relation(found));
  for (const slam::KeyframePtr& keyframe : late_keyframes_) restore(exchange_->restore_keyframe(*keyframe));
  for (const slam::FoundRelation& found : late_relations_) restore(exchange_->restore_relation(found));
  if (before) {
    late_keyframes_.clear();
    late_relations_.clear();
    // What mates said before this map was taken over is not in it.
    const slam::KeyframeSet keyframes = team::keyframes_of(before->items());
    for (const auto& [id, keyframe] : keyframes.keyframes()) {
      restore(exchange_->restore_keyframe(*keyframe));
      if (id.robot != settings_.robot && !held.contains(id)) late_keyframes_.push_back(keyframe);
    }
    const slam::RelationLog relations = team::relations_of(before->items());
    for (const slam::FoundRelation& found : relations.missing({}, relations.size())) {
      restore(exchange_->restore_relation(found));
      late_relations_.push_back(found);
    }
    for (const team::LogEntry& entry : team::log_of(before->items()))
      restore(exchange_->restore_entry(entry));
  }
  met_.clear();
  areas_.begin_map();
}

/// The map of a start that is to go on with a session begins where the robot happens to stand, which is not
/// the configured start; it is thrown away when the place is found.
bool TeamWorker::is_held_back(const OwnMapNews& news) const {
  return news.map == 1 && own_.goes_on && !hand_overs_.team.begun_anew.load(std::memory_order_acquire);
}

void TeamWorker::take_own(types::Stamp now) {
  TeamHandOver& team = hand_overs_.team;
  for (const auto* parcel = team.own.front(); parcel != nullptr; parcel = team.own.front()) {
    const std::unique_ptr<OwnMapNews> news = std::move(parcel->content);
    team.own.pop();
    own_.waits = false;
    if (!exchange_ || news->map != own_.asked.map) begin_map(*news);
    if (is_held_back(*news)) {
      own_.asked = {news->map, 0, 0, {}};
      own_.anchors.clear();
      own_.in_common_frame = false;
      continue;
    }
    for (const slam::KeyframePtr& keyframe : news->keyframes)
      if (const auto added = exchange_->add_keyframe(*keyframe); !added) warn(now, added.error().message);
    for (const slam::FoundRelation& found : news->relations)
      if (const auto added = exchange_->add_relation(found); !added) warn(now, added.error().message);
    std::uint32_t next_relation = news->map == own_.asked.map ? own_.asked.relations : 0;
    if (!news->relations.empty()) next_relation = news->relations.back().id.sequence + 1;
    own_.asked = {news->map, news->own_way, next_relation, {}};
    own_.anchors = news->anchors;
    // A session that was taken over lies where it was made: only the map of this start is in the common
    // frame.
    own_.in_common_frame = settings_.in_common_frame && news->map == 1 && !own_.goes_on;
    const team::PoseOf pose_of = [&](const slam::KeyframeId& id) -> std::optional<types::Se2> {
      const auto at = std::ranges::find(news->poses, id, &std::pair<slam::KeyframeId, types::Se2>::first);
      return at == news->poses.end() ? std::nullopt : std::optional(at->second);
    };
    for (auto& [robot, mate] : mates_) {
      const auto frame = team::mates_frame(mate.heard.message, own_.in_common_frame, pose_of);
      if (frame) mate.T_map_mates = frame;
    }
    hand_over_mates();
  }
  const auto* status = exchange_ ? team.status.take_new() : nullptr;
  if (status != nullptr) exchange_->say(said(*status));
}

team::StatusMessage TeamWorker::said(team::StatusMessage status) const {
  status.robot = settings_.robot;
  status.anchors = own_.anchors;
  status.in_common_frame = own_.in_common_frame;
  return status;
}

void TeamWorker::ask_mapping(types::Stamp now) {
  if (awaits_journal_ || own_.waits || now < own_.next_ask) return;
  OwnMapAsk* slot = hand_overs_.team.asks.try_acquire();
  if (slot == nullptr) return;
  *slot = own_.asked;
  slot->poses_of.clear();
  for (const auto& [robot, mate] : mates_) {
    const auto ids = team::anchor_ids(mate.heard.message);
    slot->poses_of.insert(slot->poses_of.end(), ids.begin(), ids.end());
  }
  hand_overs_.team.asks.commit();
  hand_overs_.mapping.wakeup.post();
  own_.waits = true;
  own_.next_ask = now + kAskPeriod;
}

void TeamWorker::take_requests(types::Stamp now) {
  auto& requests = hand_overs_.team.requests;
  for (const TeamRequest* request = requests.front(); request != nullptr; request = requests.front()) {
    if (const auto* order = std::get_if<TeamOrder>(request)) {
      order_ = exchange_->order(order->order, now);
      report_.order = order->number;
      report_.order_to = order->order.to;
    } else {
      const auto& done = std::get<OrderDone>(*request);
      exchange_->acknowledge(done.order, now, done.refused);
    }
    requests.pop();
    next_report_ = now;
  }
  if (const AreaWishes* wishes = hand_overs_.team.areas.take_new(); wishes != nullptr) areas_.want(*wishes);
}

void TeamWorker::take_news(types::Stamp now) {
  TeamHandOver& team = hand_overs_.team;
  auto* slot = team.mates.try_acquire();
  const bool room = slot != nullptr;  // else mapping is busy, and what is for it waits in the exchange
  team::ExchangeNews news = exchange_->take_news(now, room);
  for (const team::HeardOrder& order : news.orders) {
    if (!order.age) continue;  // of long ago: it came with the log
    if (auto* place = team.orders.try_acquire(); place != nullptr) {
      *place = order;
      team.orders.commit();
      team.orders_here.post();
    }
  }
  areas_.note(news.entries);
  if (areas_.settle(*exchange_)) {
    report_.areas = areas_.report();
    next_report_ = now;
  }
  for (team::HeardStatus& heard : news.statuses) note_status(std::move(heard));
  if (!news.duplicates.empty()) {
    report_.duplicates = news.duplicates;
    duplicates_until_ = now + kDuplicatesLast;
    const team::DuplicateId& id = news.duplicates.front();
    post(vitals_.events, now.time_since_epoch().count(), EventId::kTwoRobotsOneNumber, sync::Severity::kError,
         {id.robot, id.run_a, id.run_b});
  }
  if (!news.statuses.empty()) hand_over_mates();
  if (!room) return;
  auto to_mapping = std::make_unique<MatesMapNews>();
  to_mapping->map = own_.asked.map;
  relate_starts(news.keyframes, *to_mapping);
  to_mapping->keyframes =
      with_late(std::move(news.keyframes), late_keyframes_, settings_.exchange.caps.news_keyframes);
  to_mapping->relations =
      with_late(std::move(news.relations), late_relations_, settings_.exchange.caps.news_relations);
  if (!to_mapping->keyframes.empty() || !to_mapping->relations.empty() || !to_mapping->known.empty()) {
    slot->content = std::move(to_mapping);
    team.mates.commit();
    hand_overs_.mapping.wakeup.post();
  }
}

void TeamWorker::note_status(team::HeardStatus heard) {
  Mate& mate = mates_[heard.message.robot];
  if (mate.heard.run != heard.run) mate.T_map_mates.reset();
  mate.heard = std::move(heard);
  if (!mate.T_map_mates && own_.in_common_frame && mate.heard.message.in_common_frame)
    mate.T_map_mates = types::Se2{};
}

/// The starts of two robots are related when the mate's first keyframe is here and both starts are known.
void TeamWorker::relate_starts(const std::vector<slam::KeyframePtr>& keyframes, MatesMapNews& news) {
  for (const slam::KeyframePtr& keyframe : keyframes)
    if (keyframe->id.sequence == 0) started_.insert(keyframe->id.origin());
  for (const auto& [robot, mate] : mates_) {
    const slam::Origin origin{robot, mate.heard.run};
    if (met_.contains(origin) || !started_.contains(origin)) continue;
    const auto relation = team::relation_of_starts(said({}), mate.heard.message);
    if (!relation) continue;
    news.known.push_back(*relation);
    met_.insert(origin);
  }
}

/// To planning and to mapping, in this robot's map: mates whose frame is known.
void TeamWorker::hand_over_mates() {
  const types::Stamp now = io::monotonic_now();
  std::erase_if(mates_, [&](const auto& entry) { return now - entry.second.heard.heard > kForget; });
  std::vector<team::StatusMessage>& statuses = hand_overs_.team.statuses.writable();
  MatesPlaces& places = hand_overs_.team.places.writable();
  statuses.clear();
  places.places.clear();
  for (const auto& [robot, mate] : mates_) {
    if (!mate.T_map_mates) continue;
    areas_.place({robot, mate.heard.run}, *mate.T_map_mates);
    statuses.push_back(team::in_frame(*mate.T_map_mates, mate.heard.message));
    places.places.push_back({statuses.back().T_map_base.translation(), mate.heard.heard});
  }
  hand_overs_.team.statuses.publish();
  hand_overs_.team.places.publish();
}

void TeamWorker::report(types::Stamp now) {
  next_report_ = now + kReportPeriod;
  report_.joined = link_ && link_->joined();
  report_.link = link_ ? link_->link() : std::nullopt;
  report_.socket = link_ ? link_->counts() : LinkSocketCounts{};
  if (exchange_) {
    report_.counters = exchange_->counters();
    report_.peers = exchange_->peers(now);
    report_.items = exchange_->items().size();
    report_.bytes = exchange_->items().bytes();
    report_.hash = exchange_->items().hash();
    report_.streams.clear();
    for (const auto& [key, stream] : exchange_->items().streams())
      report_.streams.push_back({key, stream.first_gap()});
    if (order_) {
      report_.acknowledged = exchange_->acknowledged_by(*order_);
      report_.refused = exchange_->refused_by(*order_);
    }
    if (now > duplicates_until_) report_.duplicates.clear();
  }
  report_.statuses.clear();
  report_.located.clear();
  report_.in_map.clear();
  for (const auto& [robot, mate] : mates_) {
    report_.statuses.push_back(mate.heard);
    if (!mate.T_map_mates) continue;
    report_.located.push_back(robot);
    report_.in_map.push_back(team::in_frame(*mate.T_map_mates, mate.heard.message));
  }
  hand_overs_.team.report.store(report_);
}

}  // namespace topo::daemon
