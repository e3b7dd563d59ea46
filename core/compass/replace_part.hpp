// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace topo::compass {

/// Replaces the elements [first, end) by `others`, which may differ in number. Elements before them are not
/// touched.
template <class T>
void replace_part(std::vector<T>& all, typename std::vector<T>::iterator first,
                  typename std::vector<T>::iterator end, const std::vector<T>& others) {
  const std::ptrdiff_t common = std::min(end - first, static_cast<std::ptrdiff_t>(others.size()));
  const auto rest = std::copy_n(others.begin(), common, first);
  if (rest != end) {
    all.erase(rest, end);
    return;
  }
  const std::ptrdiff_t at = rest - all.begin();
  all.reserve(all.size() + others.size() - static_cast<std::size_t>(common));  // exactly
  all.insert(all.begin() + at, others.begin() + common, others.end());
}

}  // namespace topo::compass
