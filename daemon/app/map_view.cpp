// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/map_view.hpp"

#include <span>
#include <utility>
#include <vector>

#include "daemon/app/display_json.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;

Json trail_of(std::span<const types::KeyframePose> keyframes) {
  std::vector<types::Vector2> places;
  for (const types::KeyframePose& keyframe : keyframes)
    places.emplace_back(keyframe.T_map_base.x_m(), keyframe.T_map_base.y_m());
  return trail_json(places);
}

tl::unexpected<types::Error> no_map() {
  return fail(Errc::kNotFound, "there is no map yet: no scan was matched since the start");
}

}  // namespace

Result<Json> MapView::tiles(std::uint64_t since) {
  const auto snapshot = snapshots_.pin();
  if (!snapshot) return no_map();
  if (snapshot->revision != drawn_) book_.update(snapshot->grid);
  drawn_ = snapshot->revision;
  return tiles_json(book_.since(since, kDisplayBytes), snapshot->grid.resolution_m());
}

Result<Json> MapView::trails() {
  const auto snapshot = snapshots_.pin();
  if (!snapshot) return no_map();
  Json mates = Json::array();
  for (const auto& mate : snapshot->mates) mates.push_back(trail_of(mate));
  return Json{{"own", trail_of(snapshot->keyframes)}, {"mates", std::move(mates)}};
}

std::optional<std::vector<types::KeyframePose>> MapView::newer_keyframes() {
  const auto snapshot = snapshots_.pin();
  if (!snapshot || snapshot->revision == told_) return std::nullopt;
  told_ = snapshot->revision;
  return snapshot->keyframes;
}

}  // namespace topo::daemon
