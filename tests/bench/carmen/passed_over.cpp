// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/passed_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tests/bench/carmen/fields.hpp"

namespace topo::bench {

void PassedOver::add(int line, std::string_view word) {
  ++count_;
  std::string name = printable(word);
  const auto found = words_.find(name);
  if (found != words_.end()) {
    ++found->second.count;
  } else if (words_.size() < kWordsMax) {
    words_.emplace(std::move(name), Word{line, 1});
  }
}

std::string PassedOver::remark(std::string_view such) const {
  return fmt::format("passed over {} line{} {}: {}", count_, count_ == 1 ? "" : "s", such, named());
}

std::string PassedOver::named() const {
  constexpr std::size_t kNamed = 5;
  std::vector<std::pair<std::string, Word>> words(words_.begin(), words_.end());
  std::sort(words.begin(), words.end(),
            [](const auto& a, const auto& b) { return a.second.first_line < b.second.first_line; });
  std::string named;
  for (std::size_t k = 0; k < std::min(kNamed, words.size()); ++k) {
    const auto& [name, word] = words[k];
    named += fmt::format("{}{} of {} ({}line {})", named.empty() ? "" : ", ", word.count, name,
                         word.count > 1 ? "the first in " : "", word.first_line);
  }
  return words.size() > kNamed ? named + ", and others" : named;
}

}  // namespace topo::bench
