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
//   content       CodedContent
//
// The encoding is canonical: bytes that decode are encoded to the same bytes.
namespace topo::slam {

inline constexpr std::uint8_t kKeyframeVersion = 1;
inline constexpr std::uint8_t kKeyframeVersionWithRun = 2;

/// Encodes a keyframe.
[[nodiscard]] std::vector<std::byte> encode_keyframe(const Keyframe& keyframe);

/// Decodes a keyframe from untrusted bytes. kUnsupported: another version; kProtocol: malformed or not
/// canonical.
[[nodiscard]] types::Result<Keyframe> decode_keyframe(std::span<const std::byte> bytes);

}  // namespace topo::slam
