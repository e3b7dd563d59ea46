// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/last_contact.hpp"

#include <algorithm>
#include <cmath>

namespace topo::team {

void LastContact::heard(const types::Vector2& here, types::Stamp now) {
  place_ = here;
  since_ = now;
  put_off_ = 0;
}

void LastContact::put_off(types::Stamp now) {
  since_ = now;
  ++put_off_;
}

std::optional<types::Vector2> LastContact::lost_at(types::Stamp now) const {
  constexpr int kDoublingsMax = 10;  // of four minutes: three days
  const double wait_s = std::ldexp(lost_s_, std::clamp(put_off_ - 1, 0, kDoublingsMax));
  const bool lost = lost_s_ > 0.0 && now - since_ > types::from_seconds(wait_s);
  return lost ? place_ : std::nullopt;
}

}  // namespace topo::team
