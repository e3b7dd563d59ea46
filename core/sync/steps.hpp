// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::sync {

/// Called by the hand-overs before each step that another thread can observe. The product does nothing there;
/// a stress test passes a policy that yields, so that a thread is preempted between any two steps within
/// seconds.
struct Undisturbed {
  static constexpr void before_step() noexcept {}
};

}  // namespace topo::sync
