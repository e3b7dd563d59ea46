// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/posegraph/node_name.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace topo::bench {
namespace {

constexpr std::size_t kNameMax = 64;  // much longer than any name; bounds the memory that a file can ask for
constexpr unsigned kIndexBits = 48;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_name_character(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

}  // namespace

std::string NodeName::robot() const {
  if (!prefix.empty()) return prefix;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc{} ? std::to_string(value >> kIndexBits) : digits;
}

std::strong_ordering NodeName::operator<=>(const NodeName& other) const {
  if (const auto by = prefix <=> other.prefix; by != 0) return by;
  if (const auto by = digits.size() <=> other.digits.size(); by != 0) return by;
  return digits <=> other.digits;
}

std::optional<NodeName> parse_node_name(std::string_view word) {
  if (word.empty() || word.size() > kNameMax || !std::all_of(word.begin(), word.end(), is_name_character))
    return std::nullopt;
  std::size_t number = word.size();
  while (number > 0 && is_digit(word[number - 1])) --number;
  NodeName name{std::string(word.substr(0, number)), std::string(word.substr(number))};
  if (name.prefix.empty())
    name.digits.erase(0, std::min(name.digits.find_first_not_of('0'), name.digits.size() - 1));
  return name;
}

}  // namespace topo::bench
