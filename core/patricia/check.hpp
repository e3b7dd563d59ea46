// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <cstdlib>

namespace topo::patricia {

/// A broken invariant is a bug and aborts in every build (DESIGN section 4); systemd restarts the daemon.
inline void check(bool holds, const char* what) {
  if (holds) [[likely]] {
    return;
  }
  std::fprintf(stderr, "topometric: core/patricia: broken invariant: %s\n", what);
  std::abort();
}

}  // namespace topo::patricia
