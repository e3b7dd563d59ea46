// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <map>

#include "daemon/control/token_bucket.hpp"

namespace topo::daemon {

/// A TokenBucket for each user. A user's outlives its connections, or a new connection would bring a new
/// quota; a full one says nothing and is forgotten. Pure.
class UserQuota {
 public:
  UserQuota(types::Duration period, int burst) : fresh_(period, burst) {}

  /// Takes one of the user's tokens when there is one.
  [[nodiscard]] bool take(uid_t user, types::Stamp now) {
    std::erase_if(buckets_, [now](const auto& bucket) { return bucket.second.is_full(now); });
    return buckets_.try_emplace(user, fresh_).first->second.take(now);
  }
  /// From when on the user can take one.
  [[nodiscard]] types::Stamp next_at(uid_t user, types::Stamp now) const {
    const auto bucket = buckets_.find(user);
    return bucket == buckets_.end() ? now : bucket->second.next_at(now);
  }

 private:
  TokenBucket fresh_;
  std::map<uid_t, TokenBucket> buckets_;
};

}  // namespace topo::daemon
