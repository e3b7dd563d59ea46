// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/types/transform.hpp"

#include <gtest/gtest.h>

#include <concepts>

namespace topo::types {
namespace {

template <class A, class B>
concept CanMultiply = requires(const A& a, const B& b) {
  a* b;
};

// Products are read by adjacent letters; anything else must not compile.
static_assert(CanMultiply<Transform2<Map, Odom>, Transform2<Odom, Base>>);
static_assert(!CanMultiply<Transform2<Map, Odom>, Transform2<Map, Base>>);
static_assert(!CanMultiply<Transform2<Odom, Base>, Transform2<Map, Odom>>);
static_assert(
    std::same_as<decltype(std::declval<Transform2<Map, Odom>>() * std::declval<Transform2<Odom, Base>>()),
                 Transform2<Map, Base>>);
static_assert(std::same_as<decltype(std::declval<Transform2<Map, Odom>>().inverse()), Transform2<Odom, Map>>);

TEST(Transform2, CarriesOdometryIntoTheMap) {
  const Transform2<Map, Odom> T_map_odom(1.0, 0.0, std::numbers::pi / 2);
  const Transform2<Odom, Base> T_odom_base(2.0, 0.0, 0.0);
  const Transform2<Map, Base> T_map_base = T_map_odom * T_odom_base;
  EXPECT_NEAR(T_map_base.x_m(), 1.0, 1e-12);
  EXPECT_NEAR(T_map_base.y_m(), 2.0, 1e-12);
  EXPECT_NEAR(T_map_base.theta_rad(), std::numbers::pi / 2, 1e-12);
}

TEST(Transform2, IsTheSe2OfItsFrames) {
  const Se2 map_odom{1.0, -2.0, 0.5}, odom_base{-3.0, 0.25, 2.9};
  const Transform2<Map, Odom> T_map_odom(map_odom);
  const Transform2<Odom, Base> T_odom_base(odom_base);
  EXPECT_EQ((T_map_odom * T_odom_base).se2(), map_odom * odom_base);
  EXPECT_EQ(T_map_odom.inverse().se2(), map_odom.inverse());
  EXPECT_EQ(T_map_odom, (Transform2<Map, Odom>(1.0, -2.0, 0.5)));
  EXPECT_NE(T_map_odom, (Transform2<Map, Odom>(1.0, -2.0, 0.6)));
  EXPECT_EQ((Transform2<Map, Base>().se2()), Se2{}) << "the identity";
}

}  // namespace
}  // namespace topo::types
