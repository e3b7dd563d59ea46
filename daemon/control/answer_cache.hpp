// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/types/stamp.hpp"
#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

/// Answers that are large or costly, as text, for a moment: clients that ask for them in quick succession get
/// the same one. Pure.
class AnswerCache {
 public:
  /// Half of a planning period (exploration.planning_period_s, 0.4 s by default): nobody sees the difference.
  static constexpr types::Duration kAge = std::chrono::milliseconds(200);

  /// The answer to the request, when there is a fresh one.
  [[nodiscard]] const std::string* find(const RpcRequest& request, types::Stamp now) const {
    for (const Entry& entry : entries_) {
      if (answers(entry, request) && !entry.text.empty() && now - entry.made <= kAge) return &entry.text;
    }
    return nullptr;
  }
  /// Keeps `text` when the request is one for which that is worth while.
  void keep(const RpcRequest& request, const std::string& text, types::Stamp now) {
    for (Entry& entry : entries_) {
      if (answers(entry, request)) entry = {entry.method, text, now};
    }
  }

 private:
  struct Entry {
    std::string_view method;
    std::string text{};
    types::Stamp made{};
  };
  /// Parameters are refused by these methods: their error is not the answer to others.
  static bool answers(const Entry& entry, const RpcRequest& request) {
    return entry.method == request.method && request.params.empty();
  }
  std::array<Entry, 4> entries_{{{"goals"}, {"places"}, {"latency"}, {"config"}}};
};

}  // namespace topo::daemon
