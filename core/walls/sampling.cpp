// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/walls/sampling.hpp"

#include <vector>

namespace topo::walls {
namespace {

/// Mixes the bits of a point's place in millimetres: which points are left out must not depend on their
/// order.
std::uint64_t hash_of(const types::Vector2& p) {
  const auto mm = [](double v_m) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(v_m * 1000.0));
  };
  std::uint64_t h = mm(p.x()) * 0x9E3779B97F4A7C15U + mm(p.y()) * 0xC2B2AE3D27D4EB4FU;
  h ^= h >> 32U;
  h *= 0xD6E8FEB86659FD93U;
  return h ^ (h >> 32U);
}

/// As cards are dealt.
std::vector<float> dealt(const std::vector<float>& values) {
  constexpr std::size_t kHands = 16;
  std::vector<float> out;
  out.reserve(values.size());
  const std::size_t each = (values.size() + kHands - 1) / kHands;
  for (std::size_t i = 0; i < each; ++i)
    for (std::size_t k = i; k < values.size(); k += each) out.push_back(values[k]);
  return out;
}

}  // namespace

Sample::Sample(const types::Vector2& point) : p(point), hash(hash_of(point)) {}

float Sample::x(const Placing& placing) const {
  const double dither = placing.cell_m / 65536.0, corner = placing.cell_m / 2.0;
  const double x = p.x() - placing.middle.x() - corner + static_cast<double>(hash & 0xFFFFU) * dither;
  return static_cast<float>(x / placing.half_bin_m);
}

float Sample::y(const Placing& placing) const {
  const double dither = placing.cell_m / 65536.0, corner = placing.cell_m / 2.0;
  const double y = p.y() - placing.middle.y() - corner + static_cast<double>(hash >> 16U & 0xFFFFU) * dither;
  return static_cast<float>(y / placing.half_bin_m);
}

std::uint64_t hash_limit(std::size_t points, std::size_t size) {
  const double share = static_cast<double>(size) / static_cast<double>(points);
  constexpr double kHashes = 18446744073709551616.0;  // 2 to the power of 64
  return share >= 1.0 ? UINT64_MAX : static_cast<std::uint64_t>(share * kHashes);
}

Cloud sampled(std::span<const Sample> samples, std::uint64_t limit, const Placing& placing) {
  Cloud cloud;
  for (const Sample& sample : samples) {
    if (sample.hash > limit) continue;
    cloud.x.push_back(sample.x(placing));
    cloud.y.push_back(sample.y(placing));
  }
  return {dealt(cloud.x), dealt(cloud.y)};
}

}  // namespace topo::walls
