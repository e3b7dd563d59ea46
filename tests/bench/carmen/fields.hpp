// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "core/types/se2.hpp"
#include "tests/bench/carmen/line_source.hpp"

namespace topo::bench {

/// A word of a foreign file in a form suitable for messages: printable and short.
std::string printable(std::string_view word);

/// Splits at blanks and tabs; `words` is cleared first and keeps its storage.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// Parses the whole word as a number ("nan", "inf" and a leading plus are accepted); nothing when it is not
/// one.
std::optional<double> parse_number(std::string_view word);

/// The words of one line, with errors that give the line and the word. Indices must exist: check count()
/// first.
class Fields {
 public:
  Fields(const LineSource& source, const std::vector<std::string_view>& words)
      : source_(source), words_(words) {}

  [[nodiscard]] std::size_t count() const { return words_.size(); }
  [[nodiscard]] bool is_comment() const { return words_.front().front() == '#'; }
  [[nodiscard]] std::string_view word(std::size_t i) const { return words_[i]; }
  /// kInvalidInput unless the line has exactly `expected` words.
  [[nodiscard]] types::Status expect_count(std::size_t expected, std::string_view layout) const;
  /// A finite number within [min, max].
  [[nodiscard]] types::Result<double> number(std::size_t i, std::string_view name, double min,
                                             double max) const;
  /// A whole number within [min, max].
  [[nodiscard]] types::Result<std::size_t> count_field(std::size_t i, std::string_view name, std::size_t min,
                                                       std::size_t max) const;
  /// Three words x y theta, in metres and radians.
  [[nodiscard]] types::Result<types::Se2> pose(std::size_t i, std::string_view name) const;
  /// Seconds; a missing stamp (NaN, a host's name) is an error. Bounded so that nanoseconds fit 64 bits.
  [[nodiscard]] types::Result<double> stamp(std::size_t i, std::string_view name) const;
  [[nodiscard]] tl::unexpected<types::Error> bad(std::size_t i, std::string_view name,
                                                 std::string_view expected) const;

 private:
  const LineSource& source_;
  const std::vector<std::string_view>& words_;
};

/// Passes every line that has words to `read`, up to the end of the source or the first error of the source
/// or of `read`.
types::Status read_lines(LineSource& source, const std::function<types::Status(const Fields&)>& read);

}  // namespace topo::bench
