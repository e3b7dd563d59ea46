// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/types/result.hpp"

// A keyframe as bytes, little-endian; the one form of it in files and on the team's wire:
//
//   u8 version, u16 robot, u32 sequence, i64 stamp (ns), 3 f64 T_odom_base, 2 f32 sensor
//                 version 1: of run 0; version 2: u32 run after the robot, not 0
//   hits          count, positions
//   match points  count, u8 1: gaps from one to the next among the hits; u8 0: positions
//   surfels       count, positions, low bytes of the normals, high bytes, one bit each: planar (8 a byte)
//   columns       count, positions, slabs
//
// Counts, gaps and slabs are varints. Positions are all differences of x to the point before, then all of y,
// as zigzag varints of kPositionQuantum_m. A normal is its direction in 2^16 parts of a turn. There is
// exactly one form of a keyframe: what decodes encodes to the same bytes.
namespace topo::slam {

inline constexpr std::uint8_t kKeyframeVersion = 1;
inline constexpr std::uint8_t kKeyframeVersionWithRun = 2;

/// Positions are whole multiples, which a float holds exactly; rounding is off by at most half of it, 0.49 mm
/// an axis, where the sensors' noise is 10 to 30 mm.
inline constexpr float kPositionQuantum_m = 1.0F / 1024.0F;
/// Directions of normals are off by at most half of it, 4.8e-5 rad.
inline constexpr int kNormalParts = 1 << 16;
/// Points further than this from base_link along an axis are no evidence: no scanner of ours reaches so far,
/// and a hostile keyframe cannot make a grid of any size.
inline constexpr float kKeyframeReach_m = 128.0F;

/// Rounds a keyframe to what the codec keeps and drops points that are not finite or out of reach. Done once,
/// before a keyframe enters the map: what is saved is then what was mapped, to the bit.
void quantise(Keyframe& keyframe);

/// The keyframe's bytes. Rounds as quantise() does; of a quantised keyframe nothing is lost.
[[nodiscard]] std::vector<std::byte> encode_keyframe(const Keyframe& keyframe);

/// The keyframe of hostile bytes. kUnsupported: another version; kProtocol: no keyframe in its one form.
/// Takes at most some 30 times the bytes' size of memory, whatever they claim.
[[nodiscard]] types::Result<Keyframe> decode_keyframe(std::span<const std::byte> bytes);

}  // namespace topo::slam
