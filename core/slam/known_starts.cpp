// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/known_starts.hpp"

namespace topo::slam {

std::pair<RelationKey, Relation> known_starts(const KeyframeId& a, const types::Se2& start_a,
                                              const KeyframeId& b, const types::Se2& start_b,
                                              const StartNoise& noise) {
  if (b < a) return known_starts(b, start_b, a, start_a, noise);
  Relation relation;
  relation.T_from_to = start_a.inverse() * start_b;
  const double trans = 1.0 / (noise.trans_m * noise.trans_m);
  relation.information.diagonal() << trans, trans, 1.0 / (noise.rot_rad * noise.rot_rad);
  relation.robust = true;
  return {{a, b}, relation};
}

}  // namespace topo::slam
