// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/keyframe_set.hpp"

#include <algorithm>
#include <utility>

#include "core/slam/keyframe_codec.hpp"

namespace topo::slam {

bool KeyframeSet::insert(KeyframePtr keyframe) {
  const auto [at, added] = keyframes_.try_emplace(keyframe->id, keyframe);
  if (added) return true;
  if (at->second == keyframe || encode_keyframe(*at->second) <= encode_keyframe(*keyframe)) return false;
  at->second = std::move(keyframe);
  return true;
}

bool KeyframeSet::merge(const KeyframeSet& other) {
  bool changed = false;
  for (const auto& [id, keyframe] : other.keyframes_) changed = insert(keyframe) || changed;
  return changed;
}

KeyframePtr KeyframeSet::find(const KeyframeId& id) const {
  const auto at = keyframes_.find(id);
  return at == keyframes_.end() ? nullptr : at->second;
}

bool operator==(const KeyframeSet& a, const KeyframeSet& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.first == y.first &&
           (x.second == y.second || encode_keyframe(*x.second) == encode_keyframe(*y.second));
  };
  return std::equal(a.keyframes().begin(), a.keyframes().end(), b.keyframes().begin(), b.keyframes().end(),
                    same);
}

}  // namespace topo::slam
