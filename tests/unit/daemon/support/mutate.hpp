// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <string>

namespace topo::daemon::testing {

/// Up to four damages: a byte of any value, up to `longest` bytes gone or doubled elsewhere, the end gone.
inline std::string mutate(std::string text, std::size_t longest, std::mt19937& random) {
  const auto any = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n)(random); };
  for (std::size_t i = any(4); !text.empty() && i > 0; --i) {
    const std::size_t at = any(text.size() - 1);
    switch (any(3)) {
      case 0:
        text[at] = static_cast<char>(any(255));
        break;
      case 1:
        text.erase(at, 1 + any(longest));
        break;
      case 2:
        text.insert(at, text.substr(any(text.size() - 1), any(longest)));
        break;
      default:
        text.resize(at);
        break;
    }
  }
  return text;
}

}  // namespace topo::daemon::testing
