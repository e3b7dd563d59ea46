// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/keyframe_codec.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/slam/wall_direction.hpp"
#include "core/types/bytes.hpp"

namespace topo::slam {
namespace {

using types::Errc;
using types::Result;

// Odometry drifts, but stays within this distance of the place where the robot was switched on.
constexpr double kOdometryReach_m = 1e7;

bool read_head(types::ByteReader& in, bool with_run, Keyframe& keyframe) {
  keyframe.id.robot = in.integer<std::uint16_t>();
  if (with_run) keyframe.id.run = in.integer<std::uint32_t>();
  keyframe.id.sequence = in.integer<std::uint32_t>();
  keyframe.stamp = types::Stamp{types::Duration{in.integer<std::int64_t>()}};
  types::Se2& pose = keyframe.T_odom_base;
  pose.x_m = in.real64();
  pose.y_m = in.real64();
  pose.theta_rad = in.real64();
  const float x = in.real32(), y = in.real32();
  keyframe.sensor = Point(x, y);
  return in.ok() && is_within_reach(x) && is_within_reach(y) && std::abs(pose.x_m) <= kOdometryReach_m &&
         std::abs(pose.y_m) <= kOdometryReach_m && std::abs(pose.theta_rad) <= kOdometryReach_m;
}

}  // namespace

std::vector<std::byte> encode_keyframe(const Keyframe& keyframe) {
  types::ByteWriter out;
  const bool with_run = keyframe.id.run != 0;
  out.integer(with_run ? kKeyframeVersionWithRun : kKeyframeVersion);
  out.integer(keyframe.id.robot);
  if (with_run) out.integer(keyframe.id.run);
  out.integer(keyframe.id.sequence);
  out.integer(static_cast<std::int64_t>(keyframe.stamp.time_since_epoch().count()));
  out.real(keyframe.T_odom_base.x_m);
  out.real(keyframe.T_odom_base.y_m);
  out.real(keyframe.T_odom_base.theta_rad);
  out.real(keyframe.sensor.x());
  out.real(keyframe.sensor.y());
  out.append(keyframe.content.bytes());
  std::vector<std::byte> bytes = out.take();
  bytes.shrink_to_fit();  // robots keep all of them for others that lack them
  return bytes;
}

Result<Keyframe> decode_keyframe(std::span<const std::byte> bytes) {
  types::ByteReader in(bytes);
  const auto version = in.integer<std::uint8_t>();
  const bool with_run = version == kKeyframeVersionWithRun;
  if (in.ok() && version != kKeyframeVersion && !with_run) {
    return types::fail(Errc::kUnsupported, "keyframe: found version " + std::to_string(version) +
                                               ", expected " + std::to_string(kKeyframeVersion) + " or " +
                                               std::to_string(kKeyframeVersionWithRun));
  }
  Keyframe keyframe;
  if (!read_head(in, with_run, keyframe))
    return types::fail(Errc::kProtocol, "keyframe: cut or out of range");
  if (with_run && keyframe.id.run == 0)
    return types::fail(Errc::kProtocol, "keyframe: run 0 in the form of other runs");
  auto content = CodedContent::decode(bytes.last(in.remaining()));
  if (!content)
    return types::fail(Errc::kProtocol, "keyframe: cut, too long, out of range or not in its one form");
  keyframe.content = *std::move(content);
  keyframe.walls_rad = wall_direction(keyframe.content.surfels());
  return keyframe;
}

}  // namespace topo::slam
