// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace topo::bench {

using types::Result;
using types::Se2;
using types::Status;

namespace {

constexpr double kMaxCoordinate_m = 1e6;  // larger than any building
constexpr double kMaxAngle_rad = 1e5;     // odometers may count turns without wrapping
constexpr double kMaxStamp_s = 9.0e9;     // nanoseconds fit 64 bits

constexpr std::size_t kShown = 40;

std::string quoted(std::string_view word) {
  return fmt::format("\"{}\"{}", printable(word), word.size() > kShown ? "..." : "");
}

/// A number of a country that writes a comma where others have the point.
bool has_decimal_comma(std::string_view word) {
  std::string pointed(word);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  return pointed != word && parse_number(pointed).has_value();
}

}  // namespace

std::string printable(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, kShown)) text += c >= ' ' && c <= '~' ? c : '?';
  return text;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

std::optional<double> parse_number(std::string_view word) {
  double value = 0.0;
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

tl::unexpected<types::Error> Fields::bad(std::size_t i, std::string_view name,
                                         std::string_view expected) const {
  return source_.bad(fmt::format("{} in word {} ({})", quoted(words_[i]), i + 1, name), expected);
}

Status Fields::expect_count(std::size_t expected, std::string_view layout) const {
  if (words_.size() == expected) return {};
  return source_.bad(fmt::format("{} words", words_.size()), fmt::format("{}: {}", expected, layout));
}

Result<double> Fields::number(std::size_t i, std::string_view name, double min, double max) const {
  const auto value = parse_number(words_[i]);
  if (!value.has_value() || !(*value >= min && *value <= max)) {
    return bad(i, name,
               fmt::format("a number from {} to {}{}", min, max,
                           has_decimal_comma(words_[i]) ? ", with a point instead of the comma" : ""));
  }
  return *value;
}

Result<std::size_t> Fields::count_field(std::size_t i, std::string_view name, std::size_t min,
                                        std::size_t max) const {
  std::size_t value = 0;
  const std::string_view w = words_[i];
  const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
  if (error != std::errc{} || end != w.data() + w.size() || value < min || value > max) {
    return bad(i, name, fmt::format("a whole number from {} to {}", min, max));
  }
  return value;
}

Result<Se2> Fields::pose(std::size_t i, std::string_view name) const {
  const auto x = number(i, name, -kMaxCoordinate_m, kMaxCoordinate_m);
  if (!x.has_value()) return tl::unexpected(x.error());
  const auto y = number(i + 1, name, -kMaxCoordinate_m, kMaxCoordinate_m);
  if (!y.has_value()) return tl::unexpected(y.error());
  const auto theta = number(i + 2, name, -kMaxAngle_rad, kMaxAngle_rad);
  if (!theta.has_value()) return tl::unexpected(theta.error());
  return Se2{*x, *y, types::wrap_angle(*theta)};
}

Result<double> Fields::stamp(std::size_t i, std::string_view name) const {
  const auto value = parse_number(words_[i]);
  if (!value.has_value() || !(*value >= 0.0 && *value <= kMaxStamp_s)) {
    return bad(i, name, fmt::format("a time stamp in seconds from 0 to {}", kMaxStamp_s));
  }
  return *value;
}

Status read_lines(LineSource& source, const std::function<Status(const Fields&)>& read) {
  std::vector<std::string_view> words;
  while (true) {
    const auto line = source.next();
    if (!line.has_value()) return tl::unexpected(line.error());
    if (!line->has_value()) return {};
    split_words(**line, words);
    if (words.empty()) continue;
    if (auto s = read(Fields(source, words)); !s.has_value()) return s;
  }
}

}  // namespace topo::bench
