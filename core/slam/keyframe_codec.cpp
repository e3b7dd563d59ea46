// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/keyframe_codec.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/slam/wall_direction.hpp"
#include "core/types/bytes.hpp"

namespace topo::slam {
namespace {

using types::Errc;
using types::Result;

constexpr double kPart_rad = 2.0 * std::numbers::pi / kNormalParts;
constexpr std::int64_t kReach = static_cast<std::int64_t>(kKeyframeReach_m / kPositionQuantum_m);
// Odometry drifts, but stays within this distance of the place where the robot was switched on.
constexpr double kOdometryReach_m = 1e7;

bool within(float v) { return std::abs(v) <= kKeyframeReach_m; }  // false for a NaN
std::int64_t quanta(float v) { return std::llround(v / kPositionQuantum_m); }
float rounded(float v) { return static_cast<float>(quanta(v)) * kPositionQuantum_m; }

std::uint16_t part_of(const Point& normal) {
  const double angle = std::atan2(static_cast<double>(normal.y()), static_cast<double>(normal.x()));
  return static_cast<std::uint16_t>(std::lround(angle / kPart_rad) & 0xFFFF);
}
Point normal_of(std::uint16_t part) {
  const double angle = static_cast<std::int16_t>(part) * kPart_rad;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

// Uniform access to the positions of points, surfels and columns.
float x_of(const Point& p) { return p.x(); }
float y_of(const Point& p) { return p.y(); }
float x_of(const Surfel& s) { return s.position.x(); }
float y_of(const Surfel& s) { return s.position.y(); }
float x_of(const walls::ColumnPoint& c) { return c.x_m; }
float y_of(const walls::ColumnPoint& c) { return c.y_m; }
void put(Point& p, float x, float y) { p = Point(x, y); }
void put(Surfel& s, float x, float y) { s.position = Point(x, y); }
void put(walls::ColumnPoint& c, float x, float y) { c.x_m = x, c.y_m = y; }

template <class T>
void quantise_positions(std::vector<T>& items) {
  std::erase_if(items, [](const T& item) { return !within(x_of(item)) || !within(y_of(item)); });
  for (T& item : items) put(item, rounded(x_of(item)), rounded(y_of(item)));
}

template <class T>
void write_positions(types::ByteWriter& out, const std::vector<T>& items) {
  std::int64_t last = 0;
  for (const T& item : items) out.zigzag(quanta(x_of(item)) - std::exchange(last, quanta(x_of(item))));
  last = 0;
  for (const T& item : items) out.zigzag(quanta(y_of(item)) - std::exchange(last, quanta(y_of(item))));
}

/// Reads one axis of the positions; false when one is out of reach.
bool read_axis(types::ByteReader& in, std::vector<float>& axis) {
  std::int64_t at = 0;
  for (float& v : axis) {
    const std::int64_t step = in.zigzag();
    if (step < -2 * kReach || step > 2 * kReach || std::abs(at + step) > kReach) return false;
    at += step;
    v = static_cast<float>(at) * kPositionQuantum_m;
  }
  return in.ok();
}

/// Reads `count` items with their positions. Precondition: the caller has checked `count` against the
/// remaining bytes.
template <class T>
bool read_positions(types::ByteReader& in, std::size_t count, std::vector<T>& items) {
  std::vector<float> x(count), y(count);
  if (!in.ok() || !read_axis(in, x) || !read_axis(in, y)) return false;
  items.resize(count);
  for (std::size_t i = 0; i < count; ++i) put(items[i], x[i], y[i]);
  return true;
}

/// Writes the index of each match point among the hits, as gaps; false when the points are not a subsequence
/// of the hits.
bool gaps_among(const std::vector<Point>& points, const std::vector<Point>& hits, types::ByteWriter& gaps) {
  std::size_t next = 0;
  for (const Point& point : points) {
    const std::size_t from = next;
    while (next < hits.size() && hits[next] != point) ++next;
    if (next == hits.size()) return false;
    gaps.varint(next - from);
    ++next;
  }
  return true;
}

void write_match_points(types::ByteWriter& out, const Keyframe& keyframe) {
  out.varint(keyframe.match_points.size());
  types::ByteWriter gaps;
  if (gaps_among(keyframe.match_points, keyframe.hits, gaps)) {
    out.integer(std::uint8_t{1});
    out.append(gaps.bytes());
  } else {
    out.integer(std::uint8_t{0});
    write_positions(out, keyframe.match_points);
  }
}

bool read_match_points(types::ByteReader& in, Keyframe& keyframe) {
  const std::size_t count = in.count(1);
  const auto kind = in.integer<std::uint8_t>();
  if (kind == 0) return count <= in.remaining() / 2 && read_positions(in, count, keyframe.match_points);
  if (kind != 1 || count > keyframe.hits.size()) return false;
  keyframe.match_points.reserve(count);
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t gap = in.varint();
    if (!in.ok() || gap >= keyframe.hits.size() - next) return false;
    next += static_cast<std::size_t>(gap);
    keyframe.match_points.push_back(keyframe.hits[next++]);
  }
  return true;
}

void write_surfels(types::ByteWriter& out, const std::vector<Surfel>& surfels) {
  out.varint(surfels.size());
  write_positions(out, surfels);
  for (const Surfel& s : surfels) out.integer(static_cast<std::uint8_t>(part_of(s.normal) & 0xFFU));
  for (const Surfel& s : surfels) out.integer(static_cast<std::uint8_t>(part_of(s.normal) >> 8U));
  for (std::size_t i = 0; i < surfels.size(); i += 8) {
    unsigned bits = 0;
    for (std::size_t k = i; k < std::min(i + 8, surfels.size()); ++k)
      bits |= static_cast<unsigned>(surfels[k].planar) << (k - i);
    out.integer(static_cast<std::uint8_t>(bits));
  }
}

bool read_surfels(types::ByteReader& in, std::vector<Surfel>& surfels) {
  const std::size_t count = in.count(4);
  if (!read_positions(in, count, surfels)) return false;
  std::vector<std::uint16_t> parts(count);
  for (std::uint16_t& part : parts) part = in.integer<std::uint8_t>();
  for (std::uint16_t& part : parts)
    part = static_cast<std::uint16_t>(part | static_cast<unsigned>(in.integer<std::uint8_t>()) << 8U);
  unsigned bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 8 == 0) bits = in.integer<std::uint8_t>();
    surfels[i].normal = normal_of(parts[i]);
    surfels[i].planar = (bits >> (i % 8) & 1U) != 0;
  }
  return in.ok();
}

bool read_columns(types::ByteReader& in, std::vector<walls::ColumnPoint>& columns) {
  const std::size_t count = in.count(3);
  if (!read_positions(in, count, columns)) return false;
  for (walls::ColumnPoint& column : columns) {
    const std::uint64_t slabs = in.varint();
    if (slabs > UINT32_MAX) return false;
    column.slabs = static_cast<walls::Slabs>(slabs);
  }
  return in.ok();
}

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
  return in.ok() && within(x) && within(y) && std::abs(pose.x_m) <= kOdometryReach_m &&
         std::abs(pose.y_m) <= kOdometryReach_m && std::abs(pose.theta_rad) <= kOdometryReach_m;
}

bool read_body(types::ByteReader& in, Keyframe& keyframe) {
  return read_positions(in, in.count(2), keyframe.hits) && read_match_points(in, keyframe) &&
         read_surfels(in, keyframe.surfels) && read_columns(in, keyframe.columns) && in.complete();
}

}  // namespace

void quantise(Keyframe& keyframe) {
  quantise_positions(keyframe.hits);
  quantise_positions(keyframe.match_points);
  std::erase_if(keyframe.surfels, [](const Surfel& s) { return !s.normal.allFinite(); });
  quantise_positions(keyframe.surfels);
  for (Surfel& surfel : keyframe.surfels) surfel.normal = normal_of(part_of(surfel.normal));
  quantise_positions(keyframe.columns);
}

std::vector<std::byte> encode_keyframe(const Keyframe& given) {
  Keyframe keyframe = given;
  quantise(keyframe);
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
  out.varint(keyframe.hits.size());
  write_positions(out, keyframe.hits);
  write_match_points(out, keyframe);
  write_surfels(out, keyframe.surfels);
  out.varint(keyframe.columns.size());
  write_positions(out, keyframe.columns);
  for (const walls::ColumnPoint& column : keyframe.columns) out.varint(column.slabs);
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
  if (!read_head(in, with_run, keyframe) || !read_body(in, keyframe))
    return types::fail(Errc::kProtocol, "keyframe: cut, too long or out of range");
  // Rejects longer encodings of the same numbers and the like: two files of one map would differ.
  if (!std::ranges::equal(encode_keyframe(keyframe), bytes))
    return types::fail(Errc::kProtocol, "keyframe: not in its one form");
  keyframe.walls_rad = wall_direction(keyframe.surfels);
  return keyframe;
}

}  // namespace topo::slam
