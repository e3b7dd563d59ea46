// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/last_contact.hpp"

namespace topo::team {

void LastContact::heard(const types::Vector2& here, types::Stamp now) {
  place_ = here;
  since_ = now;
}

std::optional<types::Vector2> LastContact::lost_at(types::Stamp now) const {
  const bool lost = lost_s_ > 0.0 && now - since_ > types::from_seconds(lost_s_);
  return lost ? place_ : std::nullopt;
}

}  // namespace topo::team
