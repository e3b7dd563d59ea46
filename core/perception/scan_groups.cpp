// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/scan_groups.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace topo::perception {
namespace {

using types::Vector2;

constexpr std::size_t kSegmentsMax = 256;  // size of an array; the rest of a sweep is left out

struct Segment {
  std::size_t first = 0, last = 0, hits = 0;
};

class Segments {
 public:
  Segments(const ScanLook& look, const ScanGroupParams& params) : look_(look), params_(params) {
    for (std::size_t i = 0; i < look.beams; ++i)
      if (look.is_hit(i)) add(i);
    drop_specks();
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Segment& operator[](std::size_t i) const { return segments_[i]; }
  [[nodiscard]] double across_m(const Segment& s) const { return gap_m(s.first, s.last); }
  [[nodiscard]] double gap_m(std::size_t a, std::size_t b) const {
    return (look_.points[a] - look_.points[b]).norm();
  }
  [[nodiscard]] double range_m(std::size_t beam) const { return static_cast<double>(look_.range_m[beam]); }

  /// True when the segment's end is neither hidden by its neighbour in the scan, nor connected to it, nor cut
  /// off by the scan's end.
  [[nodiscard]] bool ends_freely(std::size_t i, bool after) const {
    const Segment& s = segments_[i];
    const std::size_t own = after ? s.last : s.first;
    if (after ? own + params_.bridged_beams >= look_.beams : own < params_.bridged_beams) return false;
    if (after ? i + 1 == size_ : i == 0) return true;
    const std::size_t other = after ? segments_[i + 1].first : segments_[i - 1].last;
    if ((after ? other - own : own - other) > 2 * params_.bridged_beams) return true;  // no neighbour
    return range_m(other) > range_m(own) + params_.behind_m;
  }

 private:
  void add(std::size_t beam) {
    if (size_ > 0) {
      Segment& s = segments_[size_ - 1];
      const double jump_m = params_.uneven_m + look_.step_rad * range_m(beam) / params_.grazing_rad;
      if (beam - s.last <= params_.bridged_beams && gap_m(beam, s.last) < jump_m) {
        s.last = beam;
        ++s.hits;
        return;
      }
      drop_specks();
    }
    if (size_ < kSegmentsMax) segments_[size_++] = {beam, beam, 1};
  }
  void drop_specks() {
    if (size_ > 0 && segments_[size_ - 1].hits < params_.hits_min) --size_;
  }

  const ScanLook& look_;
  const ScanGroupParams& params_;
  std::array<Segment, kSegmentsMax> segments_{};
  std::size_t size_ = 0;
};

/// Index of the last segment of the group that begins with segment `i`.
std::size_t end_of_group(const Segments& segments, std::size_t i, const ScanGroupParams& params) {
  std::size_t end = i;
  for (std::size_t next = i + 1; next < segments.size() && next <= end + 2; ++next) {
    const Segment& s = segments[next];
    const bool near = segments.gap_m(segments[end].last, s.first) < params.apart_m &&
                      segments.gap_m(segments[i].first, s.last) < params.across_m;
    if (near && segments.across_m(s) < params.across_m) end = next;
  }
  return end;
}

template <class Counts>
Vector2 mean(const ScanLook& look, const ScanGroup& group, Counts counts) {
  Vector2 sum(0.0, 0.0);
  double count = 0.0;
  for_each_point(look, group, [&](const Vector2& p) {
    if (counts(p)) sum += p, count += 1.0;
  });
  return sum / count;
}

Vector2 mean_near(const ScanLook& look, const ScanGroup& group, const Vector2& end, double near_m) {
  return mean(look, group, [&](const Vector2& p) { return (p - end).squaredNorm() < near_m * near_m; });
}

ScanGroup group_of(const ScanLook& look, const Segments& segments, std::size_t begin, std::size_t end,
                   const ScanGroupParams& params) {
  ScanGroup group;
  group.first = segments[begin].first;
  group.last = segments[end].last;
  group.farthest_m = std::max(segments.range_m(group.first), segments.range_m(group.last)) + params.behind_m;
  group.centre = mean(look, group, [](const Vector2&) { return true; });
  group.begin = mean_near(look, group, look.points[group.first], params.end_m);
  group.end = mean_near(look, group, look.points[group.last], params.end_m);
  for_each_point(look, group, [&](const Vector2& p) {
    group.radius_m = std::max(group.radius_m, (p - group.centre).norm());
  });
  return group;
}

}  // namespace

std::size_t find_groups(const ScanLook& look, const ScanGroupParams& params, std::span<ScanGroup> out) {
  const Segments segments(look, params);
  std::size_t count = 0;
  for (std::size_t i = 0; i < segments.size() && count < out.size(); ++i) {
    const Segment& s = segments[i];
    if (segments.range_m(s.first) > params.range_max_m || segments.across_m(s) > params.across_m) continue;
    const std::size_t end = end_of_group(segments, i, params);
    const double deep_m = std::abs(segments.range_m(s.first) - segments.range_m(segments[end].last));
    if (deep_m > params.radial_share * segments.gap_m(s.first, segments[end].last) &&
        deep_m > params.uneven_m)
      continue;
    const bool begins_freely = segments.ends_freely(i, false), ends_freely = segments.ends_freely(end, true);
    if (begins_freely || ends_freely) {
      out[count] = group_of(look, segments, i, end, params);
      out[count].begins_freely = begins_freely;
      out[count++].ends_freely = ends_freely;
    }
    i = end;
  }
  return count;
}

}  // namespace topo::perception
