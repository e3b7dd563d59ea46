// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/segment_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace topo::bench {
namespace {

using Labels = std::vector<std::uint32_t>;

constexpr std::size_t kTooSmall = 100;  // pixels

/// Gives the values above `kTooSmall` pixels the numbers from 1 in ascending order, 0 stays; how many.
std::size_t renumber(Labels& values) {
  std::map<std::uint32_t, std::size_t> pixels;
  for (std::size_t i = 0; i < values.size();) {
    const std::size_t first = i;
    while (i < values.size() && values[i] == values[first]) ++i;
    if (values[first] != 0) pixels[values[first]] += i - first;
  }
  std::uint32_t count = 0;
  std::map<std::uint32_t, std::uint32_t> number;
  for (const auto& [value, size] : pixels) number[value] = size > kTooSmall ? ++count : 0;
  for (auto& value : values) {
    if (value != 0) value = number[value];
  }
  return count;
}

/// Numbers areas of `inside` in the order of their first pixels.
Labels connected_areas(const LabelPicture& picture, std::uint32_t above) {
  Labels labels(picture.values.size(), 0);
  std::uint32_t count = 0;
  std::vector<std::size_t> stack;
  const auto width = static_cast<std::ptrdiff_t>(picture.width),
             height = static_cast<std::ptrdiff_t>(picture.height);
  const auto visit = [&](std::size_t i, std::uint32_t label) {
    if (labels[i] != 0 || picture.values[i] <= above) return;
    labels[i] = label;
    stack.push_back(i);
  };
  for (std::size_t seed = 0; seed < labels.size(); ++seed) {
    if (labels[seed] != 0 || picture.values[seed] <= above) continue;
    visit(seed, ++count);
    while (!stack.empty()) {
      const auto at = static_cast<std::ptrdiff_t>(stack.back());
      stack.pop_back();
      const std::ptrdiff_t x = at % width, y = at / width;
      for (std::ptrdiff_t v = std::max<std::ptrdiff_t>(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (std::ptrdiff_t u = std::max<std::ptrdiff_t>(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
          visit(static_cast<std::size_t>(v * width + u), count);
    }
  }
  return labels;
}

/// Lays a picture on the middle of a sheet and turns both counter-clockwise about the sheet's middle, each
/// pixel from the nearest one.
LabelPicture laid_on(const LabelPicture& picture, int width, int height, double turn_rad) {
  const int left = (width - picture.width) / 2, top = (height - picture.height) / 2;
  const double c = std::cos(turn_rad), s = std::sin(turn_rad), mid_x = 0.5 * width, mid_y = 0.5 * height;
  LabelPicture out{width, height, picture.coloured, {}};
  out.values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double dx = x + 0.5 - mid_x, dy = y + 0.5 - mid_y;
      // Rows go downwards: what turns to the left for the eye has the other sign.
      const int u = static_cast<int>(std::floor(mid_x + c * dx - s * dy)) - left;
      const int v = static_cast<int>(std::floor(mid_y + s * dx + c * dy)) - top;
      const bool inside = u >= 0 && v >= 0 && u < picture.width && v < picture.height;
      const auto from = static_cast<std::size_t>(v) * static_cast<std::size_t>(picture.width);
      out.values.push_back(inside ? picture.values[from + static_cast<std::size_t>(u)] : 0);
    }
  }
  return out;
}

/// How many pixels segments and rooms share. Row and column 0 are for pixels of none.
struct Overlaps {
  std::size_t segments, rooms;
  std::vector<double> shared;
  std::vector<double> of_segment, of_room;  ///< all their pixels

  Overlaps(const Labels& s, std::size_t segment_count, const Labels& r, std::size_t room_count)
      : segments(segment_count),
        rooms(room_count),
        shared((segment_count + 1) * (room_count + 1), 0.0),
        of_segment(segment_count + 1, 0.0),
        of_room(room_count + 1, 0.0) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      at(s[i], r[i]) += 1.0;
      of_segment[s[i]] += 1.0;
      of_room[r[i]] += 1.0;
    }
  }
  double& at(std::size_t s, std::size_t r) { return shared[s * (rooms + 1) + r]; }
  [[nodiscard]] double at(std::size_t s, std::size_t r) const { return shared[s * (rooms + 1) + r]; }
};

double correlation(double tp, double fp, double fn, double tn) {
  const double d = std::sqrt((tp + fp) * (tp + fn) * (tn + fp) * (tn + fn));
  return d > 0.0 ? (tp * tn - fp * fn) / d : 0.0;
}

/// Matches the greatest overlaps first; what finds no partner counts as 0. Only pixels that are of a segment
/// and of a room.
double matched_correlation(const Overlaps& o) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  std::vector<double> in_segment(o.segments + 1, 0.0), in_room(o.rooms + 1, 0.0);
  double all = 0.0;
  for (std::size_t s = 1; s <= o.segments; ++s) {
    for (std::size_t r = 1; r <= o.rooms; ++r) {
      const double shared = o.at(s, r);
      if (shared <= 0.0) continue;
      pairs.emplace_back(shared, s, r);
      in_segment[s] += shared;
      in_room[r] += shared;
      all += shared;
    }
  }
  std::sort(pairs.rbegin(), pairs.rend());
  std::vector<bool> segment_used(o.segments + 1, false), room_used(o.rooms + 1, false);
  double sum = 0.0;
  std::size_t matched = 0;
  for (const auto& [shared, s, r] : pairs) {
    if (segment_used[s] || room_used[r]) continue;
    segment_used[s] = room_used[r] = true;
    ++matched;
    const double fp = in_segment[s] - shared, fn = in_room[r] - shared;
    sum += correlation(shared, fp, fn, all - shared - fp - fn);
  }
  const std::size_t count = o.segments + o.rooms - matched;
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

/// Mean of the best shares, and the same weighted by area.
struct Shares {
  double micro = 0.0, macro = 0.0;
};
template <class Best>
Shares shares(std::size_t count, const std::vector<double>& area, Best&& best) {
  double ratios = 0.0, found = 0.0, sum = 0.0;
  for (std::size_t k = 1; k <= count; ++k) {
    const double b = best(k);
    ratios += b / area[k];
    found += b;
    sum += area[k];
  }
  if (count == 0) return {};
  return {ratios / static_cast<double>(count), found / sum};
}

}  // namespace

LabelPicture rooms_of(const LabelPicture& truth) {
  constexpr std::uint32_t kAboveLines = 250;
  LabelPicture rooms{truth.width, truth.height, false,
                     truth.coloured ? truth.values : connected_areas(truth, kAboveLines)};
  renumber(rooms.values);
  return rooms;
}

types::Result<SegmentScore> score(const LabelPicture& segments, const LabelPicture& rooms, double turn_rad) {
  const int more = rooms.width - segments.width;
  if (more < 0 || more % 2 != 0 || rooms.height - segments.height != more) {
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("found {} x {} pixels, expected {} x {} as the truth has", segments.width,
                                   segments.height, rooms.width, rooms.height));
  }
  Labels found = laid_on(segments, rooms.width, rooms.height, turn_rad).values;
  SegmentScore out;
  out.segments = renumber(found);
  out.rooms = *std::max_element(rooms.values.begin(), rooms.values.end());
  const Overlaps o(found, out.segments, rooms.values, out.rooms);
  const Shares precision = shares(out.segments, o.of_segment, [&](std::size_t s) {
    double best = 0.0;
    for (std::size_t r = 1; r <= o.rooms; ++r) best = std::max(best, o.at(s, r));
    return best;
  });
  const Shares recall = shares(out.rooms, o.of_room, [&](std::size_t r) {
    double best = 0.0;
    for (std::size_t s = 1; s <= o.segments; ++s) best = std::max(best, o.at(s, r));
    return best;
  });
  out.precision_micro = precision.micro;
  out.precision_macro = precision.macro;
  out.recall_micro = recall.micro;
  out.recall_macro = recall.macro;
  out.mcc = matched_correlation(o);
  return out;
}

}  // namespace topo::bench
