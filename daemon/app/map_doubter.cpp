// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/map_doubter.hpp"

#include <algorithm>

#include "daemon/mapfile/doubt_json.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kPatience = std::chrono::seconds(5);

}  // namespace

std::vector<types::Vector2> stands_beside(std::span<const slam::RevisitRegion> regions,
                                          std::span<const types::Se2> poses, slam::Way own_way) {
  std::vector<types::Vector2> stands;
  for (const slam::RevisitRegion& region : regions) {
    const auto nearest = std::ranges::min_element(own_way, {}, [&](std::size_t node) {
      return (poses[node].translation() - region.centre).squaredNorm();
    });
    if (nearest != own_way.end()) stands.push_back(poses[*nearest].translation());
  }
  return stands;
}

Json doubt_json(const FoundDoubt& found) {
  Json json = doubt_json(found.doubt);
  json["revision"] = found.revision;
  return json;
}

types::Result<FoundDoubt> MapDoubter::find(const slam::ScanCount& scans) {
  const auto news = client_.ask({}, kPatience);
  if (news == nullptr) return types::fail(types::Errc::kTimeout, "the mapping thread does not answer");
  const slam::Session& map = news->session;
  const auto snapshot = snapshots_.pin();
  if (!snapshot || map.keyframes.empty())
    return types::fail(types::Errc::kNotFound, "there is no map yet: no scan was matched since the start");
  const std::vector<std::size_t> own_way = slam::way_of(map.keyframes, robot_);
  FoundDoubt found;
  found.doubt = slam::doubt_of(map, own_way, params_, scans,
                               slam::revisit_share(map.keyframes, map.poses, snapshot->grid));
  found.map = news->map;
  found.revision = news->revision;
  if (found.doubt.is_doubted()) found.look_again = stands_beside(found.doubt.regions, map.poses, own_way);
  return found;
}

}  // namespace topo::daemon
