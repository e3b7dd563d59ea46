// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Faults in which much arrives and is wrong, over real wires, into a robot on a mission at full speed:
// nothing is touched, the daemon says what is wrong, and the robot comes back. plausibility_sim_test has the
// same of values in lock-step.
#include "tests/integration/content_faults.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/integration/fault_table.hpp"
#include "tests/integration/said.hpp"
#include "tests/integration/wire_setups.hpp"

namespace topo::test {
namespace {

struct ContentCase {
  WireSetup setup;
  ContentFault fault;
};
std::ostream& operator<<(std::ostream& out, const ContentCase& c) { return out << c.fault; }

std::vector<ContentCase> cases_of(const std::vector<ContentFault>& faults, Wires wires, bool sonar) {
  std::vector<ContentCase> all;
  std::size_t number = 0;
  for (const ContentFault& fault : faults) {
    for (WireSetup setup : setups_of(number++)) {
      setup.journal = fault.journal;
      setup.process = fault.process;
      setup.cgroup = fault.cgroup;
      if (!is_cross() && fault.tcp_only) setup.wires = Wires::kTcp;
      if (!is_cross() && fault.sonar_only) setup.sonar = true;
      if (fault.tcp_only && setup.wires != Wires::kTcp) continue;
      if (fault.sonar_only && !setup.sonar) continue;
      if (setup.wires == wires && setup.sonar == sonar) all.push_back({setup, fault});
    }
  }
  return all;
}

std::vector<ContentCase> content_cases(Wires wires, bool sonar) {
  return cases_of(content_faults(), wires, sonar);
}

bool in_guest() { return std::getenv("TOPOMETRIC_GUEST") != nullptr; }

/// All on TCP with sonar: what differs is the machine.
std::vector<ContentCase> host_cases(bool guest) {
  // One in the guest, also where its tests are only listed.
  const unsigned processors = guest ? 1 : std::thread::hardware_concurrency();
  std::vector<ContentCase> all;
  for (ContentFault& fault : host_faults()) {
    if (guest ? !in_guest() : fault.guest) continue;
    if (fault.processors > processors) continue;
    fault.tcp_only = fault.sonar_only = true;
    for (ContentCase one : cases_of({fault}, Wires::kTcp, true)) {
      one.setup.realtime = true;
      one.setup.slow = guest;
      all.push_back(one);
    }
  }
  return all;
}

/// As the daemon needs it; not everywhere is root permitted to.
bool has_realtime_rights() {
  const sched_param wanted{1}, usual{0};
  const bool permitted = ::sched_setscheduler(0, SCHED_FIFO, &wanted) == 0;
  return permitted && ::sched_setscheduler(0, SCHED_OTHER, &usual) == 0;
}

std::string name_of_content(const testing::TestParamInfo<ContentCase>& info) {
  std::string name = info.param.fault.name + suffix_of(info.param.setup);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class ContentFaults : public testing::TestWithParam<ContentCase> {
 protected:
  void SetUp() override {
    if (GetParam().setup.realtime && (::geteuid() != 0 || !has_realtime_rights()))
      GTEST_SKIP() << "needs root and real-time rights";
    rig_ = WireRig::start(GetParam().setup);
    ASSERT_NE(rig_, nullptr);
  }

  /// From the blow until it stands, or the fault has had its time; a box appears meanwhile.
  void watch(const ContentFault& fault, const Moment& hit) {
    constexpr double kOrder_s = 0.5, kAfterBox_s = 6.0, kWithoutBox_s = 6.0, kEnough_s = 1.0;
    const double end_s = fault.box_after_s < 0.0 ? kWithoutBox_s : fault.box_after_s + kAfterBox_s;
    bool ordered = false;
    int standing = 0;
    WireRig::wait(2.0 * end_s, [&] {
      const Moment now = rig_->moment();
      const double since_s = now.truth.sim_s - hit.truth.sim_s;
      if (fault.order != nullptr && !ordered && since_s > kOrder_s) ordered = rig_->try_ask(fault.order);
      if (fault.box_after_s >= 0.0 && box_.is_null() && since_s > fault.box_after_s) {
        const auto [struck, answers] =
            rig_->strike_and_hear({{{"command", "obstacle"}, {"distance_m", 1.0}}});
        box_ = answers[0]["id"];
      }
      if (!fault.deaf) said_.listen(*rig_);
      standing = now.stands ? standing + 1 : 0;
      if (standing == 1 && stood_s_ < 0.0) last_ = now;
      if (standing == 4 && stood_s_ < 0.0) {
        stood_s_ = last_.truth.sim_s - hit.truth.sim_s;
        stood_m_ = last_.truth.path_m - hit.truth.path_m;
      }
      const bool boxed = fault.box_after_s < 0.0 || !box_.is_null();
      return since_s > end_s ||
             (boxed && stood_s_ >= 0.0 && since_s > std::max(0.0, fault.box_after_s) + kEnough_s + stood_s_);
    });
  }

  std::string how_it_comes_back() {
    constexpr double kByItself_s = 12.0, kByOrder_s = 8.0;
    const auto goes_on = [this] { return rig_->moment().v_mps > 0.3; };
    if (WireRig::wait(kByItself_s, goes_on)) return "by itself";
    const auto after_order = [&] {
      if (rig_->status()["mission"]["state"] == "paused") rig_->try_ask("resume");
      return goes_on() || rig_->reach_full_speed(kByOrder_s);
    };
    if (after_order()) return "a new order";
    // A daemon that was killed proposes where the robot is; with a small map only the operator can tell.
    if (rig_->status().value(Json::json_pointer("/session/place/waits"), false)) {
      rig_->try_ask("session.confirm");
      if (after_order()) return "session confirm and a new order";
    }
    rig_->try_ask("clear_estop");
    if (after_order()) return "clear-estop and a new order";
    rig_->restart_daemon();  // a new map
    constexpr double kAgain_s = 40.0;
    return rig_->reach_full_speed(kAgain_s) ? "a restart: the map was wrong" : "not";
  }

  std::unique_ptr<WireRig> rig_;
  Said said_;
  Json box_;
  Moment last_;
  double stood_m_ = 0.0, stood_s_ = -1.0;
};

INSTANTIATE_TEST_SUITE_P(Tcp, ContentFaults, testing::ValuesIn(content_cases(Wires::kTcp, true)),
                         name_of_content);
INSTANTIATE_TEST_SUITE_P(TcpWithoutSonar, ContentFaults, testing::ValuesIn(content_cases(Wires::kTcp, false)),
                         name_of_content);
INSTANTIATE_TEST_SUITE_P(Terminal, ContentFaults, testing::ValuesIn(content_cases(Wires::kPty, true)),
                         name_of_content);
INSTANTIATE_TEST_SUITE_P(TerminalWithoutSonar, ContentFaults,
                         testing::ValuesIn(content_cases(Wires::kPty, false)), name_of_content);

INSTANTIATE_TEST_SUITE_P(Host, ContentFaults, testing::ValuesIn(host_cases(false)), name_of_content);
// Nothing where there is no guest (tests/vm/machine_faults_test.py).
INSTANTIATE_TEST_SUITE_P(Guest, ContentFaults, testing::ValuesIn(host_cases(true)), name_of_content);

TEST_P(ContentFaults, TouchNothingAreNamedAndPass) {
  const ContentFault& fault = GetParam().fault;
  if (fault.before) fault.before(*rig_);
  ASSERT_TRUE(rig_->reach_full_speed()) << rig_->status().dump(2);
  const Moment hit = rig_->strike(fault.strike);
  if (fault.act) fault.act(*rig_);
  watch(fault, hit);
  if (!fault.says.empty()) {
    constexpr double kPatience_s = 8.0;  // a link that was cut comes back, and its device says who it is
    EXPECT_TRUE(WireRig::wait(kPatience_s,
                              [&] {
                                said_.listen(*rig_);
                                return said_.has_any(fault.says);
                              }))
        << "expected: " << fault.says << ", found: " << said_.text();
  }
  if (fault.harmless) {
    EXPECT_FALSE(stood_s_ >= 0.0 && stood_s_ < fault.box_after_s) << said_.text();
    EXPECT_TRUE(rig_->status()["plausibility"]["doubts"].empty()) << said_.text();
  }
  if (fault.undo) fault.undo(*rig_);
  said_.listen(*rig_);
  EXPECT_EQ(rig_->moment().truth.collisions, hit.truth.collisions) << "it touched something";
  rig_->strike(fault.lift);
  if (!box_.is_null()) rig_->strike({{{"command", "remove-obstacle"}, {"id", box_}}});
  const std::string back = how_it_comes_back();
  EXPECT_NE(back, "not") << rig_->status().dump(2);
  const std::uint64_t touched = rig_->moment().truth.collisions - hit.truth.collisions;
  EXPECT_EQ(touched, 0U) << "it touched something when the fault was over";
  const std::string on = box_.is_null() ? "drives on" : "drives on, goes round the box";
  const std::string does = stood_s_ < 0.0 ? on : stands_after(stood_m_, stood_s_);
  std::printf("%s; %s; back: %s; at %.2f m/s, the machine was up to %.0f ms late\n", does.c_str(),
              said_.text().c_str(), back.c_str(), hit.v_mps, 1e3 * rig_->machine().late_s());
  const std::string where = GetParam().setup.slow ? ", an emulated guest" : "";
  record({fault.name, form_of(GetParam().setup) + where, does + (touched > 0 ? ", TOUCHED something" : ""),
          said_.text(fault.says), back});
}

TEST(WireFaultsTable, NamesWhatRunsElsewhere) {
  for (const Elsewhere& fault : faults_elsewhere()) {
    EXPECT_FALSE(fault.where.empty()) << fault.name;
    record({fault.name, "not run here", "", fault.where, ""});
  }
}

}  // namespace
}  // namespace topo::test
