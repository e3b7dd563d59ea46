// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace topo::daemon {

/// Text of bounded length inside the object, so that a real-time thread passes it on without allocating.
/// Longer text is truncated.
template <std::size_t N>
class FixedText {
 public:
  FixedText() = default;
  FixedText& operator=(std::string_view text) {
    size_ = std::min(text.size(), N);
    std::copy_n(text.data(), size_, text_.data());
    return *this;
  }
  [[nodiscard]] std::string_view view() const { return {text_.data(), size_}; }
  [[nodiscard]] std::string str() const { return std::string(view()); }

 private:
  std::array<char, N> text_{};
  std::size_t size_ = 0;
};

}  // namespace topo::daemon
