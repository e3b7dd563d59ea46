// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/team_control.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace topo::daemon {
namespace {

Json seconds_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json peer_json(const team::PeerView& peer, types::Stamp now) {
  return {{"robot", peer.robot},
          {"alive", peer.alive},
          {"hears_us", peer.hears_us},
          {"heard_s_ago", types::to_seconds(now - peer.heard)},
          {"round_trip_s", seconds_or_null(peer.round_trip_s)},
          {"loss_in", seconds_or_null(peer.loss_in)},
          {"loss_out", seconds_or_null(peer.loss_out)},
          {"clock_offset_s", seconds_or_null(peer.clock_offset_s)},
          {"in_step", peer.same_sets},
          {"it_lacks", {{"items", peer.it_lacks_items}, {"bytes", peer.it_lacks_bytes}}},
          {"lacks_here", {{"items", peer.lacks_here_items}, {"bytes", peer.lacks_here_bytes}}}};
}

Json status_json(const team::StatusMessage& status) {
  Json json{{"duty", team::to_text(status.duty)}, {"claim", nullptr}};
  if (status.claim) {
    json["claim"] = {
        {"x_m", status.claim->p_map.x()}, {"y_m", status.claim->p_map.y()}, {"cost_m", status.claim->cost_m}};
  }
  return json;
}

Json link_json(const TeamReport& report) {
  Json json{{"joined", report.joined},
            {"why_not", report.joined ? "" : report.words},
            {"not_sent", {{"full", report.socket.dropped_full}, {"alone", report.socket.dropped_alone}}}};
  if (!report.link) return json;
  json["radio"] = report.link->radio;
  json["mates"] = report.link->mates;
  json["sent_bytes"] = report.link->sent_bytes;
  json["received_bytes"] = report.link->received_bytes;
  Json& dropped = json["dropped"] = Json::object();
  for (std::size_t i = 0; i < kLinkDrops; ++i)
    dropped[std::string(drop_name(static_cast<LinkDrop>(i)))] = report.link->dropped[i];
  return json;
}

Json counters_json(const team::ExchangeCounters& c) {
  Json sent = Json::object();
  for (std::size_t i = 0; i < team::kMessageKinds; ++i)
    sent[std::string(team::to_text(static_cast<team::MessageKind>(i)))] = c.sent_bytes_of[i];
  return {{"sent", c.sent},
          {"sent_bytes", c.sent_bytes},
          {"sent_bytes_of", std::move(sent)},
          {"received", c.received},
          {"received_bytes", c.received_bytes},
          {"dropped",
           {{"other_version", c.other_version},
            {"other_team", c.other_team},
            {"malformed", c.malformed + c.malformed_item},
            {"replayed", c.replayed},
            {"too_many", c.too_many},
            {"contradicting", c.contradicting + c.claims_ours},
            {"duplicate_ids", c.duplicate_ids}}}};
}

std::string two_robots(int number, bool own) {
  return fmt::format("two robots have the number {}{}: give one of them another robot.id", number,
                     own ? ", which is this robot's" : "");
}

}  // namespace

void RecentDrops::note(const LinkStats& link, types::Stamp now) {
  const std::uint64_t dropped = link.dropped_by(kind_);
  const std::uint64_t more = dropped >= seen_ ? dropped - seen_ : dropped;
  seen_ = dropped;
  if (more == 0) return;
  count_ += more;
  last_ = now;
}

void RecentDrops::tick(types::Stamp now) {
  if (now - last_ > lately_) count_ = 0;
}

std::uint64_t TeamControl::order(team::OrderKind kind) {
  if (!configuration_.present) return 0;
  TeamRequest* slot = team_.requests.try_acquire();
  if (slot == nullptr) {
    spdlog::error("the team's thread takes no orders: {} was not sent to the team", team::to_text(kind));
    return 0;
  }
  *slot = TeamOrder{++orders_, {kind}};
  team_.requests.commit();
  team_.wakeup.post();
  return orders_;
}

void TeamControl::collect() {
  (void)team_.orders_here.wait(types::Duration::zero());
  for (const team::HeardOrder* heard = team_.orders.front(); heard != nullptr; heard = team_.orders.front()) {
    spdlog::warn("{}: ordered for the whole team by robot {}", team::to_text(heard->order.kind),
                 heard->id.robot);
    obey_(heard->order.kind, heard->id.robot);
    if (TeamRequest* slot = team_.requests.try_acquire(); slot != nullptr) {
      *slot = OrderDone{heard->id};
      team_.requests.commit();
      team_.wakeup.post();
    }
    team_.orders.pop();
  }
}

void TeamControl::tick(types::Stamp now) {
  if (const TeamReport* report = team_.report.take_new(); report != nullptr) report_ = *report;
  for (RecentDrops* drops : {&own_number_, &not_trusted_}) {
    if (report_.link) drops->note(*report_.link, now);
    drops->tick(now);
  }
}

std::string TeamControl::trouble() const {
  if (!configuration_.present) return {};
  if (!report_.duplicates.empty()) {
    const team::DuplicateId& two = report_.duplicates.front();
    return two_robots(two.robot, two.own);
  }
  // The link lets nothing of that robot through.
  if (own_number_.count() > 0) return two_robots(configuration_.id, true);
  if (!report_.joined) {
    return report_.words.empty() ? "alone: no link is connected; is topometric-link running?"
                                 : "alone: " + report_.words;
  }
  return {};
}

std::string TeamControl::warning() const {
  if (!configuration_.present || not_trusted_.count() == 0) return {};
  return fmt::format(
      "a robot in reach has false credentials, or this one has: {} handshakes were refused (topolink's log "
      "names it); it is not heard",
      not_trusted_.count());
}

std::string TeamControl::obstacle() const {
  if (!configuration_.present) return {};
  const bool is_double =
      own_number_.count() > 0 || std::ranges::any_of(report_.duplicates, &team::DuplicateId::own);
  return is_double ? two_robots(configuration_.id, true) : std::string();
}

std::optional<DoctorFacts::Team> TeamControl::facts() const {
  if (!configuration_.present) return {};
  const auto alive = std::ranges::count_if(report_.peers, &team::PeerView::alive);
  return DoctorFacts::Team{
      trouble(), warning(),
      fmt::format("{}: {} other robot{} in reach", configuration_.name, alive, alive == 1 ? "" : "s")};
}

Json TeamControl::brief() const {
  if (!configuration_.present) return nullptr;
  const auto alive = std::ranges::count_if(report_.peers, &team::PeerView::alive);
  const auto in_step =
      std::ranges::count_if(report_.peers, [](const auto& p) { return p.alive && p.same_sets; });
  return {{"name", configuration_.name}, {"joined", report_.joined}, {"alive", alive}, {"in_step", in_step}};
}

Json TeamControl::json(types::Stamp now) const {
  if (!configuration_.present) return {{"present", false}};
  Json peers = Json::array();
  for (const team::PeerView& peer : report_.peers) {
    Json json = peer_json(peer, now);
    const auto said = std::ranges::find_if(
        report_.statuses, [&](const team::HeardStatus& heard) { return heard.message.robot == peer.robot; });
    json["status"] = said == report_.statuses.end() ? Json() : status_json(said->message);
    json["map_joined"] = std::ranges::count(report_.located, peer.robot) > 0;
    peers.push_back(std::move(json));
  }
  return {
      {"present", true},
      {"name", configuration_.name},
      {"robot", configuration_.id},
      {"security", configuration_.secure() ? "on" : "off"},
      {"link", link_json(report_)},
      {"exchange", counters_json(report_.counters)},
      {"held",
       {{"items", report_.items}, {"bytes", report_.bytes}, {"hash", fmt::format("{:016x}", report_.hash)}}},
      {"peers", std::move(peers)},
      {"order", {{"number", report_.order}, {"acknowledged", report_.acknowledged}}},
      {"trouble", trouble()},
      {"warning", warning()}};
}

}  // namespace topo::daemon
