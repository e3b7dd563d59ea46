// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/keyframe_content.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/types/bytes.hpp"

namespace topo::slam {
namespace {

constexpr double kPart_rad = 2.0 * std::numbers::pi / kNormalParts;
constexpr std::int64_t kReach = static_cast<std::int64_t>(kKeyframeReach_m / kPositionQuantum_m);
constexpr std::array<int, 2> kAxes = {0, 1};

std::int64_t quanta(float v) { return std::llround(v / kPositionQuantum_m); }

std::uint16_t part_of(const Point& normal) {
  const double angle = std::atan2(static_cast<double>(normal.y()), static_cast<double>(normal.x()));
  return static_cast<std::uint16_t>(std::lround(angle / kPart_rad) & 0xFFFF);
}
Point normal_of(std::uint16_t part) {
  const double angle = static_cast<std::int16_t>(part) * kPart_rad;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

// Uniform access to the positions of points, surfels and columns.
float& coordinate(Point& p, int axis) { return p[axis]; }
float& coordinate(Surfel& s, int axis) { return s.position[axis]; }
float& coordinate(walls::ColumnPoint& c, int axis) { return axis == 0 ? c.x_m : c.y_m; }

template <class T>
void round_positions(std::vector<T>& items) {
  std::erase_if(items, [](T& item) {
    return !is_within_reach(coordinate(item, 0)) || !is_within_reach(coordinate(item, 1));
  });
  for (T& item : items) {
    for (const int axis : kAxes) {
      float& v = coordinate(item, axis);
      v = static_cast<float>(quanta(v)) * kPositionQuantum_m;
    }
  }
}

void round_content(KeyframeContent& content) {
  round_positions(content.hits);
  round_positions(content.match_points);
  std::erase_if(content.surfels, [](const Surfel& s) { return !s.normal.allFinite(); });
  round_positions(content.surfels);
  round_positions(content.columns);
}

template <class T>
void write_positions(types::ByteWriter& out, std::vector<T>& items) {
  for (const int axis : kAxes) {
    std::int64_t last = 0;
    for (T& item : items) {
      const std::int64_t at = quanta(coordinate(item, axis));
      out.zigzag(at - std::exchange(last, at));
    }
  }
}

/// Reads `count` items with their positions; false when one is out of reach. Precondition: the caller has
/// checked `count` against the remaining bytes.
template <class T>
bool read_positions(types::ByteReader& in, std::size_t count, std::vector<T>& items) {
  if (!in.ok()) return false;
  items.resize(count);
  for (const int axis : kAxes) {
    std::int64_t at = 0;
    for (T& item : items) {
      const std::int64_t step = in.zigzag();
      if (step < -2 * kReach || step > 2 * kReach || std::abs(at + step) > kReach) return false;
      at += step;
      coordinate(item, axis) = static_cast<float>(at) * kPositionQuantum_m;
    }
  }
  return in.ok();
}

bool read_hits(types::ByteReader& in, std::vector<Point>& hits) {
  return read_positions(in, in.count(2), hits);
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

void write_match_points(types::ByteWriter& out, KeyframeContent& content) {
  out.varint(content.match_points.size());
  types::ByteWriter gaps;
  if (gaps_among(content.match_points, content.hits, gaps)) {
    out.integer(std::uint8_t{1});
    out.append(gaps.bytes());
  } else {
    out.integer(std::uint8_t{0});
    write_positions(out, content.match_points);
  }
}

bool read_match_points(types::ByteReader& in, const std::vector<Point>& hits, std::vector<Point>& points) {
  const std::size_t count = in.count(1);
  const auto kind = in.integer<std::uint8_t>();
  if (kind == 0) return count <= in.remaining() / 2 && read_positions(in, count, points);
  if (kind != 1 || count > hits.size()) return false;
  points.reserve(count);
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t gap = in.varint();
    if (!in.ok() || gap >= hits.size() - next) return false;
    next += static_cast<std::size_t>(gap);
    points.push_back(hits[next++]);
  }
  return true;
}

void write_surfels(types::ByteWriter& out, std::vector<Surfel>& surfels) {
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

/// A part of bytes that were coded here, or have been checked.
template <class T, class Read>
std::vector<T> decoded(std::span<const std::byte> part, Read read) {
  types::ByteReader in(part);
  std::vector<T> items;
  read(in, items);
  return items;
}

}  // namespace

CodedContent::CodedContent(KeyframeContent content) {
  round_content(content);
  types::ByteWriter out;
  const auto begin = [&](Part part) { at_[part] = static_cast<std::uint32_t>(out.bytes().size()); };
  out.varint(content.hits.size());
  write_positions(out, content.hits);
  begin(kMatchPoints);
  write_match_points(out, content);
  begin(kSurfels);
  write_surfels(out, content.surfels);
  begin(kColumns);
  out.varint(content.columns.size());
  write_positions(out, content.columns);
  for (const walls::ColumnPoint& column : content.columns) out.varint(column.slabs);
  bytes_ = out.take();
  bytes_.shrink_to_fit();  // it stays for the run and does not grow
}

std::optional<CodedContent> CodedContent::decode(std::span<const std::byte> bytes) {
  types::ByteReader in(bytes);
  KeyframeContent content;
  if (!read_hits(in, content.hits) || !read_match_points(in, content.hits, content.match_points) ||
      !read_surfels(in, content.surfels) || !read_columns(in, content.columns) || !in.complete())
    return std::nullopt;
  // Refuses longer encodings of the same numbers and the like: two files of one map would differ.
  CodedContent coded(std::move(content));
  if (!std::ranges::equal(coded.bytes_, bytes)) return std::nullopt;
  return coded;
}

std::vector<Point> CodedContent::hits() const { return decoded<Point>(part(kHits), &read_hits); }

std::vector<Point> CodedContent::match_points() const {
  return decoded<Point>(part(kMatchPoints), [this](types::ByteReader& in, std::vector<Point>& points) {
    return read_match_points(in, hits(), points);
  });
}

std::vector<Surfel> CodedContent::surfels() const { return decoded<Surfel>(part(kSurfels), &read_surfels); }

std::vector<walls::ColumnPoint> CodedContent::columns() const {
  return decoded<walls::ColumnPoint>(part(kColumns), &read_columns);
}

std::size_t CodedContent::beams() const {
  types::ByteReader hits(part(kHits)), columns(part(kColumns));
  return hits.count(2) + columns.count(3);
}

}  // namespace topo::slam
