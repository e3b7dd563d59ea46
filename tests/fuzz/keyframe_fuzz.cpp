// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What a damaged file or a hostile team-mate may offer as a keyframe: it is refused, or it has exactly these
// bytes and holds nothing that would break the map.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/slam/keyframe_codec.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

bool within(const topo::slam::Point& p) {
  return p.cwiseAbs().maxCoeff() <= topo::slam::kKeyframeReach_m;  // false for a NaN
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto keyframe = topo::slam::decode_keyframe(bytes);
  if (!keyframe) {
    require(!keyframe.error().message.empty());
    return 0;
  }
  require(std::ranges::equal(topo::slam::encode_keyframe(*keyframe), bytes));
  const auto hits = keyframe->content.hits();
  const auto surfels = keyframe->content.surfels();
  const auto columns = keyframe->content.columns();
  require(hits.size() <= size && surfels.size() <= size && columns.size() <= size);
  require(keyframe->content.match_points().size() <= size);
  require(keyframe->content.beams() == hits.size() + columns.size());
  require(within(keyframe->sensor) && keyframe->T_odom_base.translation().allFinite());
  for (const auto& hit : hits) require(within(hit));
  for (const auto& surfel : surfels) require(within(surfel.position) && surfel.normal.allFinite());
  for (const auto& column : columns) require(within({column.x_m, column.y_m}));
  return 0;
}
