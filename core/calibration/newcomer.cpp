// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/newcomer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace topo::calibration {
namespace {

/// Neighbouring beams that became shorter, or several such pieces.
struct Piece {
  std::vector<std::size_t> beams;
  double width_m = 0.0;
};

bool is_nearer(const StillPicture& before, const StillPicture& now, std::size_t beam,
               const NewcomerParams& params) {
  const double r = static_cast<double>(now.range_m[beam]);
  if (!(r >= params.range_min_m && r <= params.range_max_m)) return false;
  return static_cast<double>(before.range_m[beam]) - r >= params.nearer_m;  // also from kNoReturn
}

double beam_width_m(const StillPicture& picture, std::size_t beam) {
  return static_cast<double>(picture.range_m[beam]) * std::abs(picture.angle_increment_rad);
}

std::vector<Piece> pieces_of(const StillPicture& before, const StillPicture& now,
                             const NewcomerParams& params) {
  std::vector<Piece> out;
  for (std::size_t i = 0; i < now.range_m.size(); ++i) {
    if (!is_nearer(before, now, i, params)) continue;
    if (out.empty() || i - out.back().beams.back() > params.gap_beams) out.emplace_back();
    out.back().beams.push_back(i);
    out.back().width_m += beam_width_m(now, i);
  }
  return out;
}

double apart_m(const StillPicture& picture, const Piece& a, const Piece& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : a.beams)
    for (const std::size_t j : b.beams)
      least = std::min(least, (picture.point_m(i) - picture.point_m(j)).norm());
  return least;
}

/// Joins pieces until none are near each other.
std::vector<Piece> joined(const StillPicture& picture, std::vector<Piece> pieces, double together_m) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size();) {
      if (apart_m(picture, pieces[i], pieces[j]) > together_m) {
        ++j;
        continue;
      }
      pieces[i].beams.insert(pieces[i].beams.end(), pieces[j].beams.begin(), pieces[j].beams.end());
      pieces[i].width_m += pieces[j].width_m;
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;  // the longer piece may be near one that was passed over
    }
  }
  return pieces;
}

/// Principal axis of the points about their middle.
double axis_of(const StillPicture& picture, const Piece& piece, const types::Vector2& middle_m) {
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const std::size_t i : piece.beams) {
    const types::Vector2 d = picture.point_m(i) - middle_m;
    const double w = beam_width_m(picture, i);
    xx += w * d.x() * d.x(), yy += w * d.y() * d.y(), xy += w * d.x() * d.y();
  }
  return 0.5 * std::atan2(2.0 * xy, xx - yy);
}

Newcomer newcomer_of(const StillPicture& picture, const Piece& piece) {
  Newcomer out;
  out.range_m = std::numeric_limits<double>::infinity();
  out.width_m = piece.width_m;
  types::Vector2 sum(0.0, 0.0);
  double weight = 0.0;
  for (const std::size_t i : piece.beams) {
    const double angle = picture.angle_rad(i);
    sum += beam_width_m(picture, i) * types::Vector2(std::cos(angle), std::sin(angle));
    out.middle_m += beam_width_m(picture, i) * picture.point_m(i);
    weight += beam_width_m(picture, i);
    out.range_m = std::min(out.range_m, static_cast<double>(picture.range_m[i]));
  }
  out.angle_rad = std::atan2(sum.y(), sum.x());
  out.middle_m /= weight;
  out.axis_rad = axis_of(picture, piece, out.middle_m);
  const types::Vector2 axis(std::cos(out.axis_rad), std::sin(out.axis_rad));
  const auto shorter = [&](std::size_t a, std::size_t b) {
    return picture.point_m(a).dot(axis) < picture.point_m(b).dot(axis);
  };
  const auto ends = std::minmax_element(piece.beams.begin(), piece.beams.end(), shorter);
  out.ends_m = {picture.point_m(*ends.first), picture.point_m(*ends.second)};
  return out;
}

}  // namespace

std::vector<Newcomer> newcomers(const StillPicture& before, const StillPicture& now,
                                const NewcomerParams& params) {
  const bool same = before.range_m.size() == now.range_m.size() &&
                    before.angle_min_rad == now.angle_min_rad &&
                    before.angle_increment_rad == now.angle_increment_rad;
  if (!same) return {};
  std::vector<Piece> pieces = pieces_of(before, now, params);
  // A single beam is a mixed pixel, which would join what is apart.
  std::erase_if(pieces, [](const Piece& piece) { return piece.beams.size() < 2; });
  std::vector<Newcomer> out;
  for (const Piece& piece : joined(now, std::move(pieces), params.together_m))
    if (piece.width_m >= params.width_min_m) out.push_back(newcomer_of(now, piece));
  std::sort(out.begin(), out.end(),
            [](const Newcomer& a, const Newcomer& b) { return a.width_m > b.width_m; });
  return out;
}

}  // namespace topo::calibration
