// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace topo::daemon {

/// What feeds the board asks whether a page is there to see it, and tells when there is something new on it.
struct BoardRules {
  std::function<bool()> is_watched;
  std::function<void()> changed;
};

}  // namespace topo::daemon
