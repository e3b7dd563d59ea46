// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/types/result.hpp"

// A keyframe as bytes, little-endian; the same format in files and in messages between robots:
//
//   u8 version, u16 robot, u32 sequence, i64 stamp (ns), 3 f64 T_odom_base, 2 f32 sensor
//                 version 1: of run 0; version 2: u32 run after the robot, not 0
//   hits          count, positions
//   match points  count, u8 1: gaps from one to the next among the hits; u8 0: positions
//   surfels       count, positions, low bytes of the normals, high bytes, one bit each: planar (8 a byte)
//   columns       count, positions, slabs
//
// Counts, gaps and slabs are varints. Positions are the differences of x to the previous point, for all
// points, then the same of y, as zigzag varints of kPositionQuantum_m. A normal is its direction in units of
// 1/2^16 turn. The encoding is canonical: bytes that decode are encoded to the same bytes.
namespace topo::slam {

inline constexpr std::uint8_t kKeyframeVersion = 1;
inline constexpr std::uint8_t kKeyframeVersionWithRun = 2;

/// Positions are whole multiples of this, exactly representable as floats; the rounding error is at most half
/// of it, 0.49 mm per axis, while the sensors' noise is 10 to 30 mm.
inline constexpr float kPositionQuantum_m = 1.0F / 1024.0F;
/// Directions of normals are rounded to turns of 1 / kNormalParts; the error is at most half a part, 4.8e-5
/// rad.
inline constexpr int kNormalParts = 1 << 16;
/// Points further than this from base_link along an axis are dropped: no supported scanner reaches so far,
/// and the bound limits the size of the grid that an untrusted keyframe can create.
inline constexpr float kKeyframeReach_m = 128.0F;

/// Rounds a keyframe to the precision of the codec and drops points that are not finite or out of reach.
/// Called once, before a keyframe enters the map: the saved keyframe is then bit-identical to the mapped one.
void quantise(Keyframe& keyframe);

/// Encodes a keyframe. Rounds as quantise() does; lossless for a quantised keyframe.
[[nodiscard]] std::vector<std::byte> encode_keyframe(const Keyframe& keyframe);

/// Decodes a keyframe from untrusted bytes. kUnsupported: another version; kProtocol: malformed or not
/// canonical. Allocates at most about 30 times the size of the bytes, whatever counts they claim.
[[nodiscard]] types::Result<Keyframe> decode_keyframe(std::span<const std::byte> bytes);

}  // namespace topo::slam
