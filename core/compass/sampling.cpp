// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/sampling.hpp"

#include <bit>

namespace topo::compass {
namespace {

/// Hash of a point's position in millimetres: which points are left out must not depend on their order.
std::uint64_t hash_of(const types::Vector2& p) {
  const auto mm = [](double v_m) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(v_m * 1000.0));
  };
  std::uint64_t h = mm(p.x()) * 0x9E3779B97F4A7C15U + mm(p.y()) * 0xC2B2AE3D27D4EB4FU;
  h ^= h >> 32U;
  h *= 0xD6E8FEB86659FD93U;
  return h ^ (h >> 32U);
}

/// Approximate number of points in a bucket: few enough for a linear search.
constexpr std::size_t kInBucket = 64;

}  // namespace

Sample::Sample(const types::Vector2& point) : p(point), hash(hash_of(point)) {}

void Sample::append_to(Cloud& cloud, const Placing& placing) const {
  const double dither = placing.cell_m / 65536.0, corner = placing.cell_m / 2.0;
  const double x = p.x() - placing.middle.x() - corner + static_cast<double>(hash & 0xFFFFU) * dither;
  const double y = p.y() - placing.middle.y() - corner + static_cast<double>(hash >> 16U & 0xFFFFU) * dither;
  cloud.x.push_back(static_cast<float>(x / placing.half_bin_m));
  cloud.y.push_back(static_cast<float>(y / placing.half_bin_m));
}

std::uint64_t hash_limit(std::size_t points, std::size_t size) {
  const double share = static_cast<double>(size) / static_cast<double>(points);
  constexpr double kHashes = 18446744073709551616.0;  // 2 to the power of 64
  return share >= 1.0 ? UINT64_MAX : static_cast<std::uint64_t>(share * kHashes);
}

Samples::Samples(std::span<const types::Vector2> points)
    : shift_(32U - static_cast<unsigned>(std::bit_width(points.size() / kInBucket))),
      buckets_(std::size_t{1} << (32U - shift_)) {
  const std::size_t even = points.size() / buckets_.size();
  for (auto& bucket : buckets_) bucket.reserve(even + even / 4);  // mostly sufficient
  for (const types::Vector2& p : points) {
    const Sample sample(p);
    buckets_[bucket_of(sample.hash)].push_back(sample);
  }
}

Cloud Samples::up_to(std::uint64_t limit, const Placing& placing) const {
  Cloud cloud;
  for (std::size_t b = 0; b <= bucket_of(limit); ++b)
    for (const Sample& sample : buckets_[b])
      if (sample.hash <= limit) sample.append_to(cloud, placing);
  return cloud;
}

}  // namespace topo::compass
