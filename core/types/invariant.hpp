// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <cstdlib>

namespace topo::types {

/// A broken invariant is a bug and aborts in every build (DESIGN "Rules of the house"), before anything is
/// written where it does not belong; systemd starts the daemon again. `what` names the place and the bound.
inline void require(bool holds, const char* what) {
  if (holds) [[likely]] {
    return;
  }
  std::fprintf(stderr, "topometric: broken invariant: %s\n", what);
  std::abort();
}

}  // namespace topo::types
