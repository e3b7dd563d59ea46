// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::test {

/// How often a check is repeated with other values: `often`, or `seldom` under AddressSanitizer, which makes
/// all of it five times as slow. It looks for errors of memory, which depend little on the values; the plain
/// build looks at all.
constexpr int times([[maybe_unused]] int often, [[maybe_unused]] int seldom) {
#ifdef __SANITIZE_ADDRESS__
  return seldom;
#else
  return often;
#endif
}

}  // namespace topo::test
