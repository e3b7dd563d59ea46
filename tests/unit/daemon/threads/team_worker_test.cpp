// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/team_worker.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <thread>

#include "core/slam/keyframe_codec.hpp"
#include "core/team/exchange/exchange.hpp"
#include "daemon/link/daemon_line.hpp"
#include "drivers/io/posix.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using team::testing::sample_keyframe;

/// A robot of which the team's thread is true; mapping, planning, main and link are played by the test.
class Robot {
 public:
  Robot(std::uint16_t number, std::uint32_t run, const testing::TempDir& folder, bool awaits_journal = false)
      : origin_{number, run},
        settings_(settings_of(number, folder, awaits_journal)),
        line_(settings_.socket, {team_hash("test"), number}) {}
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;
  ~Robot() {
    hand_overs->ending.stopping = true;
    hand_overs->team.wakeup.post();
    thread_.join();
  }

  void make_keyframe() {
    const slam::KeyframeId id{origin_.robot, static_cast<std::uint32_t>(own_.size()), origin_.run};
    own_.push_back(std::make_shared<const slam::Keyframe>(sample_keyframe(id, 100)));
  }

  /// A turn of the other threads. `pass_on`: the radio.
  void turn(const std::function<void(std::span<const std::byte>)>& pass_on) {
    for (const OwnMapAsk* ask = hand_overs->team.asks.front(); ask != nullptr;
         ask = hand_overs->team.asks.front()) {
      answer(*ask);
      hand_overs->team.asks.pop();
    }
    for (const auto* news = mapping_is_busy ? nullptr : hand_overs->team.mates.front(); news != nullptr;
         news = hand_overs->team.mates.front()) {
      for (const auto& keyframe : news->content->keyframes) joined.push_back(keyframe);
      known_starts += news->content->known.size();
      hand_overs->team.mates.pop();
    }
    if (const auto* heard = hand_overs->team.statuses.take_new(); heard != nullptr) statuses = *heard;
    if (const auto* newest = hand_overs->team.report.take_new(); newest != nullptr) report = *newest;
    for (const auto* order = hand_overs->team.orders.front(); order != nullptr;
         order = hand_overs->team.orders.front()) {
      orders.push_back(*order);
      hand_overs->team.orders.pop();
    }
    std::uint64_t wrong = 0;
    (void)line_.turn(io::monotonic_now(), pass_on, wrong);
    EXPECT_EQ(wrong, 0U);
    line_.send_stats({});
  }
  void receive(std::uint16_t sender, std::span<const std::byte> datagram) {
    (void)line_.send(sender, datagram);
  }
  void say(const team::StatusMessage& status) { hand_overs->team.status.store(status); }
  void request(const TeamRequest& wish) {
    TeamRequest* slot = hand_overs->team.requests.try_acquire();
    ASSERT_NE(slot, nullptr);
    *slot = wish;
    hand_overs->team.requests.commit();
    hand_overs->team.wakeup.post();
  }

  std::unique_ptr<HandOvers> hand_overs = std::make_unique<HandOvers>();
  std::vector<slam::KeyframePtr> joined;
  std::vector<team::StatusMessage> statuses;
  std::vector<team::HeardOrder> orders;
  TeamReport report;
  std::vector<slam::FoundRelation> held_relations;  ///< that the map was begun with
  std::size_t known_starts = 0;
  bool mapping_is_busy = false;
  std::uint64_t map = 1;

 private:
  static TeamSettings settings_of(std::uint16_t number, const testing::TempDir& folder, bool awaits_journal) {
    TeamSettings settings;
    settings.name = "test";
    settings.robot = number;
    settings.in_common_frame = true;
    settings.awaits_journal = awaits_journal;
    settings.socket = folder.file("link" + std::to_string(number));
    return settings;
  }
  void answer(const OwnMapAsk& ask) {
    auto* slot = hand_overs->team.own.try_acquire();
    if (slot == nullptr) return;
    auto news = std::make_unique<OwnMapNews>();
    news->map = map;
    news->origin = origin_;
    const std::size_t from = ask.map == map ? ask.keyframes : 0;
    news->keyframes.assign(own_.begin() + static_cast<std::ptrdiff_t>(from), own_.end());
    news->own_way = own_.size();
    if (ask.map != map) news->held_relations = held_relations;
    if (!own_.empty()) news->anchors = {{origin_.run, 0, {1.0 * origin_.robot, 0.0, 0.0}}};
    slot->content = std::move(news);
    hand_overs->team.own.commit();
    hand_overs->team.wakeup.post();
  }

  slam::Origin origin_;
  TeamSettings settings_;
  std::vector<slam::KeyframePtr> own_;
  DaemonLine line_;
  Vitals vitals_{"team"};
  TeamWorker worker_{*hand_overs, settings_, vitals_};
  std::thread thread_{[this] { worker_.run(); }};
};

class TeamWorkerTest : public ::testing::Test {
 protected:
  /// Turns of all threads until something holds. False: it did not within a minute.
  bool until(const std::function<bool()>& holds, bool radio = true) {
    const types::Stamp limit = io::monotonic_now() + 60s;
    while (io::monotonic_now() < limit) {
      a.turn([&](auto datagram) {
        if (radio) b.receive(1, datagram);
      });
      b.turn([&](auto datagram) {
        if (radio) a.receive(2, datagram);
      });
      if (holds()) return true;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }

  testing::TempDir folder_;
  Robot a{1, 11, folder_}, b{2, 22, folder_};
};

TEST_F(TeamWorkerTest, KeyframesOfAMateReachMappingOnce) {
  for (int i = 0; i < 30; ++i) a.make_keyframe();
  EXPECT_TRUE(until([&] { return b.joined.size() >= 30; }));
  EXPECT_TRUE(until([&] { return b.report.hash == a.report.hash && b.report.items > 0; }));
  std::set<slam::KeyframeId> ids;
  for (const auto& keyframe : b.joined) ids.insert(keyframe->id);
  EXPECT_EQ(ids.size(), 30U);
  EXPECT_EQ(b.joined.size(), 30U);
  EXPECT_TRUE(a.joined.empty());
}

TEST_F(TeamWorkerTest, WhatWasMadeApartComesTogether) {
  EXPECT_TRUE(until([&] { return a.report.joined && b.report.joined; }, false));
  for (int i = 0; i < 20; ++i) a.make_keyframe();
  for (int i = 0; i < 25; ++i) b.make_keyframe();
  EXPECT_TRUE(until([&] { return a.report.items >= 20 && b.report.items >= 25; }, false));
  EXPECT_TRUE(a.joined.empty() && b.joined.empty());
  EXPECT_TRUE(until([&] { return a.joined.size() == 25 && b.joined.size() == 20; }));
}

TEST_F(TeamWorkerTest, AStatusComesInThisRobotsMap) {
  a.make_keyframe();
  b.make_keyframe();
  team::StatusMessage status;
  status.T_map_base = {3.0, 4.0, 0.0};
  status.duty = team::Duty::kAble;
  // As planning does: a status that is lost is followed by another.
  ASSERT_TRUE(until([&] {
    b.say(status);
    return a.statuses.size() == 1;
  }));
  EXPECT_EQ(a.statuses.front().robot, 2);
  EXPECT_NEAR(a.statuses.front().T_map_base.x_m, 3.0, 1e-9) << "both maps are in the common frame";
  EXPECT_TRUE(until([&] {
    b.say(status);
    a.say(status);
    return a.known_starts == 1 && b.known_starts == 1;
  })) << "the starts are related, once";
}

TEST_F(TeamWorkerTest, AnOrderReachesTheMateAndIsAcknowledged) {
  a.make_keyframe();
  b.make_keyframe();
  EXPECT_TRUE(until([&] { return !a.report.peers.empty() && !b.report.peers.empty(); }));
  a.request(TeamOrder{1, {team::OrderKind::kEstop}});
  ASSERT_TRUE(until([&] { return !b.orders.empty(); }));
  EXPECT_EQ(b.orders.front().order.kind, team::OrderKind::kEstop);
  EXPECT_EQ(b.orders.front().id.robot, 1);
  EXPECT_TRUE(a.report.acknowledged.empty()) << "nobody has carried it out";
  b.request(OrderDone{b.orders.front().id});
  EXPECT_TRUE(
      until([&] { return a.report.order == 1 && a.report.acknowledged == std::vector<std::uint16_t>{2}; }));
  EXPECT_EQ(b.orders.size(), 1U);
  EXPECT_EQ(a.report.order_to, std::nullopt) << "it was for all";
  a.request(TeamOrder{2, {team::OrderKind::kPause, std::uint16_t{2}}});
  ASSERT_TRUE(until([&] { return a.report.order == 2 && b.orders.size() == 2; }));
  EXPECT_EQ(a.report.order_to, std::uint16_t{2});
  b.request(OrderDone{b.orders.back().id, "it stands"});
  EXPECT_TRUE(until([&] {
    return a.report.refused == std::map<std::uint16_t, std::string>{{2, "it stands"}};
  }));
}

TEST_F(TeamWorkerTest, AnOrderWaitsForNoMapping) {
  b.mapping_is_busy = true;
  // More than its ring holds, each in a parcel of its own.
  for (int i = 0; i < 20; ++i) {
    a.make_keyframe();
    const auto count = static_cast<std::size_t>(i) + 1;
    ASSERT_TRUE(until([&] { return b.report.items >= count; }));
  }
  a.request(TeamOrder{1, {team::OrderKind::kEstop}});
  EXPECT_TRUE(until([&] { return !b.orders.empty(); }));
  EXPECT_TRUE(b.joined.empty());
  b.mapping_is_busy = false;
  EXPECT_TRUE(until([&] { return b.joined.size() == 20; })) << "what waited comes";
}

TEST_F(TeamWorkerTest, AnotherMapKeepsWhatMatesSaid) {
  for (int i = 0; i < 10; ++i) a.make_keyframe();
  EXPECT_TRUE(until([&] { return b.joined.size() == 10; }));
  b.joined.clear();
  ++b.map;  // a session was taken over that holds nothing of the mate
  EXPECT_TRUE(until([&] { return b.joined.size() == 10; })) << "mapping gets them again, for the new map";
  EXPECT_TRUE(until([&] { return b.report.items == 10; }));
}

TEST_F(TeamWorkerTest, WhatTheJournalHoldsIsNotFetchedAgain) {
  for (int i = 0; i < 40; ++i) a.make_keyframe();
  ASSERT_TRUE(until([&] { return b.joined.size() == 40; }));
  Robot again(3, 33, folder_, true);
  const auto one_turn = [&] {
    a.turn([&](auto datagram) { again.receive(1, datagram); });
    again.turn([&](auto datagram) { a.receive(3, datagram); });
    std::this_thread::sleep_for(1ms);
  };
  for (int i = 0; i < 500; ++i) one_turn();
  EXPECT_EQ(again.report.items, 0U) << "nothing is asked for before the journal is read";
  auto* slot = again.hand_overs->team.journalled.try_acquire();
  slot->content = std::make_unique<JournalledItems>(JournalledItems{b.joined, {}});
  again.hand_overs->team.journalled.commit();
  for (int i = 0; i < 30'000 && !(again.report.items == 40 && again.joined.size() == 40); ++i) one_turn();
  for (int i = 0; i < 500; ++i) one_turn();
  EXPECT_EQ(again.report.hash, a.report.hash);
  EXPECT_EQ(again.joined.size(), 40U) << "the map that was begun gets them";
  again.make_keyframe();
  for (int i = 0; i < 500; ++i) one_turn();
  EXPECT_EQ(a.report.items, 40U) << "the map of this start begins at no known place";
  again.hand_overs->team.begun_anew = true;
  for (int i = 0; i < 30'000 && a.report.items < 41; ++i) one_turn();
  EXPECT_EQ(a.report.items, 41U) << "it stays, on the operator's word";
  std::size_t bytes = 0;
  for (const auto& keyframe : b.joined) bytes += slam::encode_keyframe(*keyframe).size();
  EXPECT_LT(again.report.counters.received_bytes, bytes / 2);
}

TEST_F(TeamWorkerTest, RelationsOfEarlierRunsAreTheSameAgain) {
  for (std::uint32_t i = 1; i <= 20; ++i) b.held_relations.push_back(team::testing::odometry({2, i, 21}));
  ++b.map;  // a session is taken over
  EXPECT_TRUE(until([&] { return a.report.items == 20 && a.report.hash == b.report.hash; }));
  ++b.map;  // and once more
  b.make_keyframe();
  EXPECT_TRUE(until([&] { return b.report.items == 21 && a.report.hash == b.report.hash; }));
  EXPECT_EQ(a.report.items, 21U) << "the keyframe is all that is new";
}

TEST_F(TeamWorkerTest, WithoutALinkTheRobotIsAlone) {
  a.make_keyframe();
  EXPECT_TRUE(until([&] { return a.report.items == 1; }, false));
  EXPECT_TRUE(a.statuses.empty());
  EXPECT_TRUE(a.report.peers.empty());
}

}  // namespace
}  // namespace topo::daemon
