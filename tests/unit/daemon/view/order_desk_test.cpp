// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/order_desk.hpp"

#include <gmock/gmock.h>

#include <deque>

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class OrderDeskTest : public ::testing::Test {
 protected:
  void estop() {
    Act act;
    act.kind = Act::Kind::kEstop;
    act.method = "estop";
    desk.give(act, [this](const types::Result<Json>& answer) { note(answer); });
  }
  void order(const std::string& method) {
    Act act;
    act.method = method;
    desk.give(act, [this](const types::Result<Json>& answer) { note(answer); });
  }
  void note(const types::Result<Json>& answer) {
    answers.push_back(answer ? "done" : answer.error().message);
  }
  void daemon_answers(const types::Result<Json>& answer = Json::object()) {
    ASSERT_FALSE(waiting.empty());
    const OrderDesk::Done done = waiting.front();
    waiting.pop_front();
    done(answer);
  }

  std::vector<std::string> said, answers;
  std::deque<OrderDesk::Done> waiting;
  OrderDesk desk{[this](const std::string& method, const Json&, OrderDesk::Done done) {
    said.push_back(method);
    waiting.push_back(std::move(done));
  }};
};

TEST_F(OrderDeskTest, OrdersGoOnAtOnce) {
  order("start");
  order("home");
  estop();
  EXPECT_THAT(said, ElementsAre("start", "home", "estop"));
  daemon_answers(types::fail(types::Errc::kBusy, "there is no map yet"));
  EXPECT_THAT(answers, ElementsAre("there is no map yet"));
}

TEST_F(OrderDeskTest, EstopsThatComeMeanwhileAreSaidAsOne) {
  for (int i = 0; i < 5; ++i) estop();
  EXPECT_THAT(said, ElementsAre("estop"));
  daemon_answers();
  EXPECT_THAT(answers, ElementsAre("done"));
  EXPECT_THAT(said, ElementsAre("estop", "estop")) << "each is said after it came";
  daemon_answers();
  EXPECT_EQ(answers.size(), 5U);
  EXPECT_EQ(said.size(), 2U);
}

TEST_F(OrderDeskTest, AnEstopAfterTheLastIsSaidAgain) {
  estop();
  daemon_answers();
  estop();
  EXPECT_THAT(said, ElementsAre("estop", "estop"));
}

TEST_F(OrderDeskTest, WhoeverFloodsTheEstopIsStillSaid) {
  for (std::size_t i = 0; i < 10 * OrderDesk::kWaitingMax; ++i) estop();
  EXPECT_EQ(answers.size(), 9 * OrderDesk::kWaitingMax - 1) << "these get no other answer";
  EXPECT_THAT(answers.front(), HasSubstr("too many"));
  daemon_answers();
  EXPECT_EQ(said.size(), 2U);
}

TEST_F(OrderDeskTest, OrdersAreBounded) {
  for (std::size_t i = 0; i < OrderDesk::kWaitingMax + 1; ++i) order("pause");
  EXPECT_EQ(said.size(), OrderDesk::kWaitingMax);
  EXPECT_THAT(answers, ElementsAre(HasSubstr("too many")));
  daemon_answers();
  order("pause");
  EXPECT_EQ(said.size(), OrderDesk::kWaitingMax + 1);
}

TEST(OrderDeskWithoutADaemon, EveryEstopGetsItsAnswer) {
  int answers = 0;
  OrderDesk desk([](const std::string&, const Json&, const OrderDesk::Done& done) {
    done(types::fail(types::Errc::kClosed, "no daemon answers"));
  });
  Act act;
  act.kind = Act::Kind::kEstop;
  for (int i = 0; i < 3; ++i)
    desk.give(act, [&](const types::Result<Json>& answer) { answers += answer.has_value() ? 0 : 1; });
  EXPECT_EQ(answers, 3);
}

}  // namespace
}  // namespace topo::daemon
