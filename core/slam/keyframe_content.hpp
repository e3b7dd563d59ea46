// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/slam/surfel.hpp"
#include "core/walls/height_column.hpp"

namespace topo::slam {

/// Positions are whole multiples of this, exactly representable as floats; the rounding error is at most half
/// of it, 0.49 mm per axis, while the sensors' noise is 10 to 30 mm.
inline constexpr float kPositionQuantum_m = 1.0F / 1024.0F;
/// Directions of normals are rounded to turns of 1 / kNormalParts; the error is at most half a part, 4.8e-5
/// rad.
inline constexpr int kNormalParts = 1 << 16;
/// Points further than this from base_link along an axis are dropped: no supported scanner reaches so far,
/// and the bound limits the size of the grid that an untrusted keyframe can create.
inline constexpr float kKeyframeReach_m = 128.0F;
/// Is a coordinate within it? A NaN is not.
inline bool is_within_reach(float v_m) { return std::abs(v_m) <= kKeyframeReach_m; }

/// What a keyframe contributes to the map, in base_link at its stamp.
struct KeyframeContent {
  std::vector<Point> hits;                  ///< ends of the rays
  std::vector<Surfel> surfels;              ///< for matching other scans against this keyframe
  std::vector<Point> match_points;          ///< for matching this keyframe against others
  std::vector<walls::ColumnPoint> columns;  ///< seen by the coronal laser since the keyframe before
};

/// A keyframe's content as a map keeps it: its bytes, a quarter of what the parts take. Immutable. A part is
/// decoded at each call: a function that reads one often decodes it once.
///
///   hits          count, positions
///   match points  count, u8 1: gaps from one to the next among the hits; u8 0: positions
///   surfels       count, positions, low bytes of the normals, high bytes, one bit each: planar (8 a byte)
///   columns       count, positions, slabs
///
/// Counts, gaps and slabs are varints. Positions are the differences of x to the previous point, for all
/// points, then the same of y, as zigzag varints of kPositionQuantum_m. A normal is its direction in units of
/// 1/2^16 turn. The encoding is canonical: one content has one form.
class CodedContent {
 public:
  CodedContent() : CodedContent(KeyframeContent{}) {}
  /// Rounds to the precision of the form and drops points that are not finite or out of reach.
  explicit CodedContent(KeyframeContent content);
  /// Of untrusted bytes; nothing where they are malformed or not the one form of what they say. Allocates at
  /// most about 30 times the size of the bytes, whatever counts they claim.
  [[nodiscard]] static std::optional<CodedContent> decode(std::span<const std::byte> bytes);

  [[nodiscard]] std::vector<Point> hits() const;
  [[nodiscard]] std::vector<Surfel> surfels() const;
  [[nodiscard]] std::vector<Point> match_points() const;
  [[nodiscard]] std::vector<walls::ColumnPoint> columns() const;
  /// Hits and columns, counted without decoding them: what it costs to draw the keyframe.
  [[nodiscard]] std::size_t beams() const;
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  friend bool operator==(const CodedContent& a, const CodedContent& b) { return a.bytes_ == b.bytes_; }

 private:
  enum Part : std::uint8_t { kHits, kMatchPoints, kSurfels, kColumns };
  [[nodiscard]] std::span<const std::byte> part(Part part) const {
    // One that was moved from is of nothing.
    return at_[part] <= bytes_.size() ? bytes().subspan(at_[part]) : std::span<const std::byte>{};
  }

  std::vector<std::byte> bytes_;
  std::array<std::uint32_t, 4> at_{};  ///< where each part begins
};

}  // namespace topo::slam
