// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace topo::bench {

/// Counts the lines of a file that its reader does not use, by their first words, so that they are said once.
class PassedOver {
 public:
  void add(int line, std::string_view word);

  [[nodiscard]] int count() const { return count_; }
  /// "passed over 3 lines SUCH: 2 of EQUIV (the first in line 7), 1 of TAG (line 9)"; at most five words are
  /// named, in the order of the file.
  [[nodiscard]] std::string remark(std::string_view such) const;
  /// The named words of it alone.
  [[nodiscard]] std::string named() const;

 private:
  struct Word {
    int first_line = 0;
    int count = 0;
  };
  static constexpr std::size_t kWordsMax = 1000;  ///< of a file in which each line begins differently

  std::map<std::string, Word, std::less<>> words_;
  int count_ = 0;
};

}  // namespace topo::bench
