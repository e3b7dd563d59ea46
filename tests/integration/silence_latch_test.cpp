// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A base that does not obey is stopped by its own watchdog, which every byte would feed: the silence towards
// it outlives the daemon, however that ends, until the base is released (topometricd(8), silence.latch).
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "tests/integration/fault_table.hpp"
#include "tests/integration/said.hpp"
#include "tests/integration/wire_setups.hpp"

namespace topo::test {
namespace {

/// How the silence ends.
struct Release {
  std::string name;
  Wires wires = Wires::kTcp;
  std::string by, back;  ///< as in the table
  void (*release)(WireRig& rig) = nullptr;
};
std::ostream& operator<<(std::ostream& out, const Release& release) { return out << release.name; }

std::vector<Release> releases() {
  return {
      {"ByTheOperator", Wires::kTcp, "clear-estop", "clear-estop and a new order",
       [](WireRig& rig) { rig.ask("clear_estop"); }},
      {"ByMotorsOff", Wires::kPty, "motors off", "its motors off, and a new order",
       [](WireRig& rig) {
         rig.strike({{{"command", "motors-off"}}});
       }},
      {"ByAReset", Wires::kPty, "a reset", "a reset of its controller, and a new order",
       [](WireRig& rig) {
         rig.strike({{{"command", "reset"}, {"device", "base"}}});
       }},
  };
}

class SilenceOutlivesTheDaemon : public testing::TestWithParam<Release> {
 protected:
  static constexpr double kPatience_s = 20.0;

  void SetUp() override {
    WireSetup setup;
    setup.wires = GetParam().wires;
    setup.process = true;
    rig_ = WireRig::start(setup);
    ASSERT_NE(rig_, nullptr);
  }

  [[nodiscard]] std::uint64_t heard() const { return rig_->moment().base_bytes; }
  [[nodiscard]] bool is_latched() const { return std::filesystem::exists(rig_->state_file("silence.latch")); }

  /// A robot at full speed whose base swallows the operator's stop: the daemon has had its last words.
  Moment disobey() {
    EXPECT_TRUE(rig_->reach_full_speed()) << rig_->status().dump(2);
    rig_->strike({{{"command", "disobey"}}});
    rig_->ask("stop");
    const Moment hit = rig_->moment();
    EXPECT_TRUE(WireRig::wait(kPatience_s, [this] { return is_latched(); })) << rig_->status().dump(2);
    std::uint64_t before = 0;
    int quiet_looks = 0;  // of 20 ms: E_STOP is written in three periods of 50 ms, and to TCP at once
    EXPECT_TRUE(WireRig::wait(kPatience_s, [&] {
      const std::uint64_t now = heard();
      quiet_looks = now == before ? quiet_looks + 1 : 0;
      before = now;
      return quiet_looks >= 10;
    }));
    return hit;
  }

  /// A daemon that found the latch: it says so, takes no order, and the base hears nothing of it.
  void is_bound(std::uint64_t silent_at) {
    ASSERT_TRUE(WireRig::wait(kPatience_s, [this] {
      said_.listen(*rig_);
      return said_.has("moves otherwise than commanded") && said_.has("did not obey: nothing is sent");
    })) << said_.text();
    constexpr double kOrders_s = 4.0;  // two watchdogs
    EXPECT_FALSE(WireRig::wait(kOrders_s,
                               [&] {
                                 rig_->try_ask("drive", {{"v_mps", 0.3}, {"omega_radps", 0.0}});
                                 rig_->try_ask("goto", {{"x_m", 5.0}, {"y_m", 0.0}});
                                 return heard() != silent_at;
                               }))
        << heard() - silent_at << " bytes to a base that does not obey";
    EXPECT_TRUE(is_latched());
    EXPECT_TRUE(rig_->moment().stands);
  }

  std::unique_ptr<WireRig> rig_;
  Said said_;
};

std::string name_of_release(const testing::TestParamInfo<Release>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(, SilenceOutlivesTheDaemon, testing::ValuesIn(releases()), name_of_release);

TEST_P(SilenceOutlivesTheDaemon, UntilTheBaseIsReleased) {
  const Moment hit = disobey();
  const Moment silent = rig_->moment();
  EXPECT_GT(silent.v_mps, 0.3) << "it is the watchdog that stops it, later";
  constexpr int kStillMoved = 1;  // topometric-estop(8)
  rig_->kill_daemon([&] {
    EXPECT_EQ(rig_->run_estop(), kStillMoved) << "it only listens, and tells what it hears";
    EXPECT_EQ(heard(), silent.base_bytes);
  });
  ASSERT_TRUE(WireRig::wait(kPatience_s, [&] { return rig_->moment().stands; }));
  const Moment stood = rig_->moment();
  is_bound(silent.base_bytes);
  rig_->restart_daemon();  // in order: closing sends nothing either
  is_bound(silent.base_bytes);
  rig_->strike({{{"command", "disobey"}, {"on", false}}});
  is_bound(silent.base_bytes);  // that it might obey again is not known

  GetParam().release(*rig_);
  EXPECT_TRUE(WireRig::wait(kPatience_s, [&] { return !is_latched() && rig_->is_ready(); }))
      << rig_->status().dump(2);
  EXPECT_GT(heard(), silent.base_bytes);
  EXPECT_TRUE(rig_->moment().stands) << "it goes off by an order only";
  EXPECT_TRUE(WireRig::wait(kPatience_s, [this] {
    rig_->try_ask("drive", {{"v_mps", 0.3}, {"omega_radps", 0.0}});
    return rig_->moment().v_mps > 0.2;
  })) << rig_->status().dump(2);
  EXPECT_EQ(rig_->moment().truth.collisions, hit.truth.collisions);
  const double way_m = stood.truth.path_m - hit.truth.path_m, time_s = stood.truth.sim_s - hit.truth.sim_s;
  std::printf("killed while its base does not obey: stands after %.2f m, %.2f s\n", way_m, time_s);
  WireSetup setup;
  setup.wires = GetParam().wires;
  record({"base: swallows every command, then the daemon is killed; released by " + GetParam().by,
          form_of(setup), stands_after(way_m, time_s), said_.text("moves otherwise"),
          HasFailure() ? "not as it should" : GetParam().back});
}

}  // namespace
}  // namespace topo::test
