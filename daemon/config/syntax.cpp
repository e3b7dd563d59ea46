// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/syntax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace topo::daemon {
namespace {

Place to_place(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

/// Blanks line `number` (from 1) when it is a "key = value" line, which keeps the line numbers, and returns
/// the key's name; otherwise changes nothing and returns an empty name.
std::string blank_line(std::string& text, int number) {
  std::size_t begin = 0;
  for (int line = 1; line < number; ++line) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return {};
    ++begin;
  }
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  const std::size_t first = text.find_first_not_of(" \t\r", begin);
  const std::size_t equals = text.find('=', begin);
  if (first >= end || equals >= end || text[first] == '[') return {};
  const std::size_t last = text.find_last_not_of(" \t", equals - 1);
  std::string name = first == equals ? "=" : text.substr(first, last + 1 - first);
  text.replace(begin, end - begin, end - begin, ' ');
  return name;
}

}  // namespace

ParsedToml parse_toml(std::string_view text) {
  constexpr int kMaxFaults = 20;  // a file with more faults is probably not TOML
  ParsedToml parsed;
  std::string rest(text);
  while (true) {
    // The library reports faults as exceptions; a configuration is read before the service is ready.
    try {
      parsed.root = toml::parse(rest);
      return parsed;
    } catch (const toml::parse_error& error) {
      const Place place = to_place(error.source().begin);
      parsed.faults.push_back({place, fmt::format("no valid TOML: {}", error.description())});
      std::string key =
          static_cast<int>(parsed.faults.size()) < kMaxFaults ? blank_line(rest, place.line) : "";
      if (!key.empty()) {
        parsed.left_out.push_back(std::move(key));
        continue;
      }
      parsed.complete = false;
      return parsed;
    }
  }
}

}  // namespace topo::daemon
