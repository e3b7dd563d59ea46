// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/team_control.hpp"
#include "drivers/io/posix.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>

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

/// Where a mate is, and means to go, in this robot's map; null while its map frame is not known here.
Json here_json(const TeamReport& report, std::uint16_t robot) {
  const auto mate = std::ranges::find(report.in_map, robot, &team::StatusMessage::robot);
  if (mate == report.in_map.end()) return nullptr;
  Json way = Json::array();
  for (const types::Vector2& p : mate->way_map) way.push_back({{"x_m", p.x()}, {"y_m", p.y()}});
  Json claim;
  if (mate->claim) claim = {{"x_m", mate->claim->p_map.x()}, {"y_m", mate->claim->p_map.y()}};
  const types::Se2& pose = mate->T_map_base;
  return {{"pose", {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}}},
          {"claim", std::move(claim)},
          {"way", std::move(way)}};
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
            {"false_number", c.false_number},
            {"malformed", c.malformed + c.malformed_item},
            {"replayed", c.replayed},
            {"too_many", c.too_many},
            {"contradicting", c.contradicting + c.claims_ours},
            {"duplicate_ids", c.duplicate_ids}}}};
}

Json held_json(const TeamReport& report) {
  constexpr std::array<const char*, team::kItemKinds> kKinds{"log", "relation", "keyframe"};
  Json streams = Json::array();
  for (const HeldStream& stream : report.streams)
    streams.push_back({{"kind", kKinds.at(static_cast<std::size_t>(stream.key.kind))},
                       {"robot", stream.key.origin.robot},
                       {"run", stream.key.origin.run},
                       {"first_gap", stream.first_gap}});
  return {{"items", report.items},
          {"bytes", report.bytes},
          {"hash", fmt::format("{:016x}", report.hash)},
          {"streams", std::move(streams)}};
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

std::uint64_t TeamControl::send(const team::Order& order) {
  if (!configuration_.present) return 0;
  TeamRequest* slot = team_.requests.try_acquire();
  if (slot == nullptr) {
    spdlog::error("the team's thread takes no orders: {} was not sent to the team",
                  team::to_text(order.kind));
    return 0;
  }
  *slot = TeamOrder{++orders_, order};
  team_.requests.commit();
  team_.wakeup.post();
  return orders_;
}

types::Result<std::uint64_t> TeamControl::order_one(team::OrderKind kind, std::uint16_t robot,
                                                    types::Stamp now) {
  if (!configuration_.present) return types::fail(types::Errc::kBusy, "this robot has no team");
  const auto peer = std::ranges::find(report_.peers, robot, &team::PeerView::robot);
  if (peer == report_.peers.end())
    return types::fail(types::Errc::kBusy, fmt::format("robot {} was not heard: nothing was sent", robot));
  if (!peer->alive)
    return types::fail(types::Errc::kBusy,
                       fmt::format("robot {} is out of reach, heard {:.0f} s ago: nothing was sent", robot,
                                   types::to_seconds(now - peer->heard)));
  const std::uint64_t number = send({kind, robot});
  if (number == 0) return types::fail(types::Errc::kBusy, "too many orders wait to be sent; say it again");
  return number;
}

/// An order that sets the robot in motion is obeyed while its giver still looks, and never after a later one
/// of that giver or a halt by whomever: what is repeated over a bad link arrives late, and in any order.
std::string TeamControl::outdated(const team::HeardOrder& heard) const {
  constexpr types::Duration kFresh = std::chrono::seconds(2);
  if (!team::sets_in_motion(heard.order.kind)) return {};
  if (!heard.age) return "when it was given is not known";
  if (*heard.age > kFresh) return fmt::format("it came {:.0f} s late", types::to_seconds(*heard.age));
  if (io::monotonic_now() - *heard.age < halted_) return "the robot was halted after it was given";
  const auto newest = newest_heard_.find(heard.id.origin());
  if (newest != newest_heard_.end() && newest->second > heard.id.sequence)
    return "a later order came before it";
  return {};
}

void TeamControl::collect() {
  (void)team_.orders_here.wait(types::Duration::zero());
  for (const team::HeardOrder* heard = team_.orders.front(); heard != nullptr; heard = team_.orders.front()) {
    spdlog::warn("{}: ordered {} by robot {}", team::to_text(heard->order.kind),
                 heard->order.to ? "for this robot" : "for the whole team", heard->id.robot);
    std::string refused = outdated(*heard);
    if (refused.empty())
      if (const auto done = obey_(heard->order.kind, heard->id.robot); !done) refused = done.error().message;
    if (!refused.empty()) spdlog::warn("{}: refused: {}", team::to_text(heard->order.kind), refused);
    std::uint32_t& newest = newest_heard_[heard->id.origin()];
    newest = std::max(newest, heard->id.sequence);
    if (TeamRequest* slot = team_.requests.try_acquire(); slot != nullptr) {
      *slot = OrderDone{heard->id, refused};
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

Json TeamControl::order_json() const {
  Json refused = Json::array();
  for (const auto& [robot, why] : report_.refused) refused.push_back({{"robot", robot}, {"why", why}});
  return {{"number", report_.order},
          {"to", report_.order_to ? Json(*report_.order_to) : Json()},
          {"acknowledged", report_.acknowledged},
          {"refused", std::move(refused)}};
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
    json["here"] = here_json(report_, peer.robot);
    peers.push_back(std::move(json));
  }
  return {{"present", true},
          {"name", configuration_.name},
          {"robot", configuration_.id},
          {"security", configuration_.secure() ? "on" : "off"},
          {"link", link_json(report_)},
          {"exchange", counters_json(report_.counters)},
          {"held", held_json(report_)},
          {"peers", std::move(peers)},
          {"order", order_json()},
          {"trouble", trouble()},
          {"warning", warning()}};
}

}  // namespace topo::daemon
