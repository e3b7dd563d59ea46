// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/outbox.hpp"

#include <gmock/gmock.h>

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Json tiles(int first, int count, const std::string& cells) {
  Json list = Json::array();
  for (int i = 0; i < count; ++i) list.push_back(Json::array({first + i, 0, cells}));
  return {{"revision", 1}, {"more", false}, {"resolution_m", 0.05}, {"side", 64}, {"tiles", list}};
}

class OutboxTest : public ::testing::Test {
 protected:
  OutboxTest() { outbox.show(); }
  Json next(Outbox& box) {
    const Text text = box.next(board);
    return text == nullptr ? Json() : Json::parse(*text);
  }
  /// What the messages are about, until there is none.
  std::vector<std::string> all(Outbox& box) {
    std::vector<std::string> kinds;
    for (Json message = next(box); !message.is_null() && kinds.size() < 1000; message = next(box))
      kinds.push_back(message["t"]);
    return kinds;
  }

  Board board;
  Outbox outbox;
};

TEST_F(OutboxTest, AnswersThenStateThenEventsThenTheMap) {
  ASSERT_TRUE(board.take_tiles(tiles(0, 1, "g")));
  board.add_event({{"event", "ready"}});
  board.post(Topic::kTrails, {});
  board.post(Topic::kStatus, {});
  board.post(Topic::kLink, {});
  ASSERT_TRUE(outbox.answer({{"t", "answer"}}));
  EXPECT_THAT(all(outbox), ElementsAre("answer", "link", "status", "trails", "event", "map"));
  EXPECT_THAT(all(outbox), IsEmpty());
}

TEST_F(OutboxTest, TheNewestWins) {
  for (int i = 0; i < 100; ++i) board.post(Topic::kStatus, {{"n", i}});
  EXPECT_EQ(next(outbox)["v"]["n"], 99);
  ASSERT_EQ(next(outbox)["t"], "map");  // that there is none yet
  EXPECT_TRUE(next(outbox).is_null());
}

TEST_F(OutboxTest, WhatIsAsBeforeIsSentAgainOnlyToShowLife) {
  board.post(Topic::kStatus, {{"n", 1}});
  board.post(Topic::kGoals, {{"n", 1}});
  EXPECT_THAT(all(outbox), ElementsAre("status", "goals", "map"));
  board.post(Topic::kStatus, {{"n", 1}});
  board.post(Topic::kGoals, {{"n", 1}});
  EXPECT_THAT(all(outbox), ElementsAre("status"));
  board.post(Topic::kGoals, {{"n", 2}});
  EXPECT_THAT(all(outbox), ElementsAre("goals"));
}

TEST_F(OutboxTest, StateWaitsForOnePartOfTheMap) {
  ASSERT_TRUE(board.take_tiles(tiles(0, 40, std::string(1000, 'g'))));
  EXPECT_EQ(next(outbox)["tiles"].size(), 16U);
  board.post(Topic::kStatus, {});
  EXPECT_EQ(next(outbox)["t"], "status");
  EXPECT_EQ(next(outbox)["tiles"].size(), 16U);
  EXPECT_EQ(next(outbox)["tiles"].size(), 8U);
  EXPECT_TRUE(next(outbox).is_null());
}

TEST_F(OutboxTest, ATileThatChangedAgainIsSentOnceAndNew) {
  ASSERT_TRUE(board.take_tiles(tiles(0, 2, "g")));
  ASSERT_TRUE(board.take_tiles(tiles(0, 1, "Q")));
  const Json map = next(outbox);
  EXPECT_EQ(map["tiles"], Json::parse(R"([[1, 0, "g"], [0, 0, "Q"]])"));
  ASSERT_TRUE(board.take_tiles(tiles(1, 1, "A")));
  EXPECT_EQ(next(outbox)["tiles"], Json::parse(R"([[1, 0, "A"]])"));
}

TEST_F(OutboxTest, AnotherMapIsToldAndSentFromTheBeginning) {
  ASSERT_TRUE(board.take_tiles(tiles(0, 2, "g")));
  const Json before = next(outbox);
  board.forget_map();
  const Json empty = next(outbox);
  EXPECT_NE(empty["map"], before["map"]);
  EXPECT_TRUE(empty["tiles"].empty());
  ASSERT_TRUE(board.take_tiles(tiles(5, 1, "g")));
  EXPECT_EQ(next(outbox)["tiles"].size(), 1U);
}

TEST_F(OutboxTest, OldEventsGoBeforeTheyArePiledUp) {
  for (int i = 0; i < 100; ++i) board.add_event({{"n", i}});
  EXPECT_EQ(next(outbox)["v"]["n"], 36) << "64 are kept";
  Outbox other;
  other.show();
  EXPECT_EQ(next(other)["v"]["n"], 36) << "each page has its own place";
}

TEST_F(OutboxTest, WhoMayNotLookGetsAnswersAlone) {
  Outbox blind;
  board.post(Topic::kStatus, {});
  ASSERT_TRUE(blind.answer({{"t", "hello"}}));
  EXPECT_THAT(all(blind), ElementsAre("hello"));
  blind.show();
  EXPECT_EQ(next(blind)["t"], "status");
}

TEST_F(OutboxTest, APageThatReadsNoAnswersIsDropped) {
  bool taken = true;
  int answers = 0;
  for (; taken && answers < 1000; ++answers) taken = outbox.answer({{"t", "answer"}});
  EXPECT_EQ(answers, 33);
}

TEST(Board, WhatIsNoMapIsNotTaken) {
  Board board;
  for (const char* text :
       {"{}", R"({"tiles": 3, "side": 64, "resolution_m": 0.05})",
        R"({"tiles": [[1, 2]], "side": 64, "resolution_m": 0.05})",
        R"({"tiles": [[1, 2, 3]], "side": 64, "resolution_m": 0.05})",
        R"({"tiles": [], "side": 0, "resolution_m": 0.05})", R"({"tiles": [], "side": 64})"})
    EXPECT_FALSE(board.take_tiles(Json::parse(text))) << text;
  EXPECT_EQ(board.map_number(), 0U);
}

TEST(Board, WhatIsNotUtf8IsReplaced) {
  Board board;
  board.post(Topic::kStatus, {{"identity", "\xff"}});
  EXPECT_EQ(Json::parse(*board.at(Topic::kStatus).text)["v"]["identity"], "\xEF\xBF\xBD");
}

}  // namespace
}  // namespace topo::daemon
