// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/sip.hpp"

#include <gtest/gtest.h>

#include "core/types/se2.hpp"
#include "tests/unit/drivers/pioneer/hex.hpp"

namespace topo::pioneer {
namespace {

using types::Stamp;

const RobotModel& dx() { return *find_model("p3dx-sh"); }

Bytes vector_payload() { return {kStatusVector.begin() + 3, kStatusVector.end() - 2}; }

TEST(Sip, DecodesTheVector) {
  const auto p = decode_status(vector_payload());
  ASSERT_TRUE(p);
  EXPECT_TRUE(p->moving);
  EXPECT_EQ(p->x_counts, 32766);
  EXPECT_EQ(p->y_counts, 5);
  EXPECT_EQ(p->heading_units, -1024);
  EXPECT_EQ(p->left_velocity, 195);
  EXPECT_EQ(p->right_velocity, 205);
  EXPECT_EQ(p->flags, 7);
  ASSERT_EQ(p->echoes, 2U);
  EXPECT_EQ(p->echo[0].index, 3);
  EXPECT_EQ(p->echo[0].range_units, 1500);
  EXPECT_EQ(p->echo[1].range_units, 4995);
  EXPECT_EQ(p->digital_in, 0xFF);
  EXPECT_EQ(p->battery_x10, 127);
  EXPECT_EQ(p->rotation_decidegps, 16);
  EXPECT_EQ(p->fault_flags, 0);
  EXPECT_FALSE(p->temperature_c);
  EXPECT_FALSE(p->state_of_charge_percent);
}

TEST(Sip, ConvertsTheVectorToSi) {
  const auto p = decode_status(vector_payload());
  ASSERT_TRUE(p);
  types::BaseState state;
  const Stamp arrival{std::chrono::seconds(3)};
  apply_status(*p, dx(), arrival, state);
  EXPECT_EQ(state.arrival, arrival);
  EXPECT_TRUE(state.motors_enabled);
  EXPECT_FALSE(state.stop_button);
  EXPECT_FLOAT_EQ(state.battery_v, 12.7F);
  EXPECT_LT(state.state_of_charge, 0.0F);
  EXPECT_FALSE(state.charging);
  EXPECT_FLOAT_EQ(state.sonar[3].range_m, 1.5F);
  EXPECT_EQ(state.sonar[3].stamp, arrival);
  EXPECT_EQ(state.sonar[0].stamp, Stamp{});
  const auto twist = measured_twist(*p, dx());
  EXPECT_DOUBLE_EQ(twist.v_mps, 0.2);
  EXPECT_NEAR(twist.omega_radps, 1.6 * types::kDegree_rad, 1e-4);  // what ROTVEL says
}

TEST(Sip, EveryFieldAfterTheSonarIsOptional) {
  const Bytes whole = vector_payload();
  const std::size_t fixed = 20 + 2 * 3;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const auto p = decode_status(std::span(whole).first(size));
    EXPECT_EQ(p.has_value(), size >= fixed) << size;
    if (!p) continue;
    EXPECT_EQ(p->digital_in.has_value(), size >= fixed + 4) << size;
    EXPECT_EQ(p->battery_x10.has_value(), size >= fixed + 7) << size;
    EXPECT_EQ(p->charge_state.has_value(), size >= fixed + 8) << size;
    EXPECT_EQ(p->rotation_decidegps.has_value(), size >= fixed + 10) << size;
    EXPECT_EQ(p->fault_flags.has_value(), size >= fixed + 12) << size;
  }
}

TEST(Sip, UsesTheCoarseBatteryFieldWhenTheOtherIsMissing) {
  Bytes payload = vector_payload();
  payload[11] = std::byte{118};
  payload.resize(20 + 6);
  const auto p = decode_status(payload);
  ASSERT_TRUE(p);
  types::BaseState state;
  apply_status(*p, dx(), Stamp{}, state);
  EXPECT_FLOAT_EQ(state.battery_v, 11.8F);
}

TEST(Sip, SplitsStallAndBumperBits) {
  Bytes payload = vector_payload();
  const auto decode = [&](unsigned low, unsigned high) {
    payload[12] = static_cast<std::byte>(low);
    payload[13] = static_cast<std::byte>(high);
    types::BaseState state;
    apply_status(*decode_status(payload), dx(), Stamp{}, state);
    return state;
  };
  EXPECT_TRUE(decode(0x01, 0).stall_left);
  EXPECT_FALSE(decode(0x01, 0).stall_right);
  EXPECT_TRUE(decode(0, 0x01).stall_right);
  EXPECT_EQ(decode(0x80, 0).bumpers_rear, 0x40);
  EXPECT_EQ(decode(0x02, 0).bumpers_rear, 0x01);
  EXPECT_EQ(decode(0, 0x02).bumpers_front, 0x01);
  EXPECT_EQ(decode(0, 0x82).bumpers_front, 0x41);
  EXPECT_EQ(decode(0x01, 0x01).bumpers_front, 0);
}

TEST(Sip, ReadsStopButtonAndCharger) {
  Bytes payload = vector_payload();
  payload[16] = std::byte{0x60};
  payload[17] = std::byte{0x04};
  types::BaseState state;
  apply_status(*decode_status(payload), dx(), Stamp{}, state);
  EXPECT_TRUE(state.stop_button);
  EXPECT_TRUE(state.charging);
  EXPECT_FALSE(state.motors_enabled);
}

TEST(Sip, RejectsASonarCountBeyondThePacket) {
  Bytes payload = vector_payload();
  payload[19] = std::byte{0xFF};
  EXPECT_FALSE(decode_status(payload));
  payload[19] = std::byte{8};
  EXPECT_FALSE(decode_status(payload));
}

TEST(Sip, IgnoresSonarNumbersThatDoNotExist) {
  Bytes payload = vector_payload();
  payload[20] = std::byte{200};
  types::BaseState state;
  apply_status(*decode_status(payload), dx(), Stamp{std::chrono::seconds(1)}, state);
  EXPECT_EQ(state.sonar[3].stamp, Stamp{});
  EXPECT_FLOAT_EQ(state.sonar[4].range_m, 4.995F);
}

TEST(RobotModels, KnowsBothRobotsWithBothBoards) {
  for (const char* name : {"p3dx-sh", "p3at-sh", "p3dx", "p3at", "P3DX-SH"})
    EXPECT_NE(find_model(name), nullptr) << name;
  EXPECT_EQ(find_model("peoplebot-sh"), nullptr);
  EXPECT_EQ(find_model(""), nullptr);
  EXPECT_NEAR(2.0 / find_model("p3at-sh")->radps_per_mmps, 588.0, 0.5);
  EXPECT_EQ(find_model("p3dx")->mm_per_count, 0.485);
  EXPECT_NE(known_families().find("p3at-sh"), std::string::npos);
}

TEST(RobotModels, AFamilyIsKnownByItsBoard) {
  struct Row {
    const char* subclass;
    const char* family;  ///< null: refused
  };
  for (const Row& row :
       {Row{"p3dx-sh-lms1xx", "p3dx-sh"}, Row{"P3DX-SH-LMS500", "p3dx-sh"}, Row{"p3at-sh-lms1xx", "p3at-sh"},
        Row{"p3atiw-sh", "p3atiw-sh"}, Row{"p3atiw-sh-lms500", "p3atiw-sh"}, Row{"p3dx", "p3dx"},
        Row{"p3at", "p3at"}, Row{"p2d8+", "p2d8+"}, Row{"p3dx-lms200", nullptr}, Row{"p3dx-sh-", nullptr},
        Row{"p3dx-shx", nullptr}, Row{"p3dx-s", nullptr}, Row{"", nullptr}, Row{"pioneer-lx", nullptr}}) {
    const RobotModel* family = find_family(row.subclass);
    ASSERT_EQ(family != nullptr, row.family != nullptr) << row.subclass;
    EXPECT_EQ(family != nullptr ? family->subclass : "", row.family != nullptr ? row.family : "");
  }
  EXPECT_EQ(find_family("p3atiw-sh")->chassis, "p3at");
}

TEST(RobotModels, WhatIsAssumedIsNamed) {
  EXPECT_EQ(assumption("p3dx-sh", *find_family("p3dx-sh")), "");
  EXPECT_EQ(assumption("P3AT-SH", *find_family("P3AT-SH")), "");
  EXPECT_EQ(assumption("p3dx-sh-lms1xx", *find_family("p3dx-sh-lms1xx")),
            "\"p3dx-sh-lms1xx\" is driven as p3dx-sh: 1 mm a count, track 0.357 m, hull of a p3dx");
  EXPECT_EQ(assumption("p3at", *find_family("p3at")),
            "\"p3at\" is driven as p3at: 0.465 mm a count, track 0.588 m, hull of a p3at");
}

TEST(RobotModels, SonarsAreMirroredLeftToRight) {
  for (const char* name : {"p3dx-sh", "p3at-sh"}) {
    const auto& sonars = find_model(name)->T_base_sonar;
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_DOUBLE_EQ(sonars[i].y_m, -sonars[7 - i].y_m) << name << i;
      EXPECT_DOUBLE_EQ(sonars[i].theta_rad, -sonars[7 - i].theta_rad) << name << i;
      EXPECT_DOUBLE_EQ(sonars[8 + i].y_m, -sonars[15 - i].y_m) << name << i;
    }
  }
}

}  // namespace
}  // namespace topo::pioneer
