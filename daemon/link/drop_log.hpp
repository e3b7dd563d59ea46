// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/types/stamp.hpp"
#include "daemon/link/link_wire.hpp"

namespace topo::daemon {

/// One line a minute at most says what was dropped since the last, by kind: a stranger that floods the radio
/// does not flood the log.
class DropLog {
 public:
  /// The line, when it is time and something was dropped: "dropped since the last minute: 3 another team, 1
  /// repeated".
  [[nodiscard]] std::optional<std::string> line(types::Stamp now, const LinkStats& stats);

 private:
  std::optional<types::Stamp> last_;
  LinkStats told_;
};

}  // namespace topo::daemon
