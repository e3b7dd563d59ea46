// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/contest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace topo::bench {
namespace {

using types::Errc;
using types::fail;

bool is_baseline(const Entrant& entrant) { return !entrant.strategy.starts_with("topometric"); }

/// STRATEGY:ROBOTS or STRATEGY:ROBOTS:RADIO; the radio stays empty where none is named.
std::optional<Entrant> parse_entrant(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == 0 || colon == std::string_view::npos) return std::nullopt;
  Entrant entrant{std::string(text.substr(0, colon)), 0, ""};
  const std::string_view rest = text.substr(colon + 1);
  const std::string_view robots = rest.substr(0, rest.find(':'));
  const auto [stop, error] = std::from_chars(robots.data(), robots.data() + robots.size(), entrant.robots);
  if (error != std::errc{} || stop != robots.data() + robots.size()) return std::nullopt;
  if (robots.size() < rest.size()) entrant.radio = rest.substr(robots.size() + 1);
  return entrant;
}

/// Those who are meant, with the first radio that fits.
std::vector<Entrant> find_entrants(Entrant wanted, std::span<const Entrant> entrants) {
  std::vector<Entrant> found;
  for (const Entrant& entrant : entrants) {
    const bool fits =
        wanted.strategy == kBestBaseline ? is_baseline(entrant) : entrant.strategy == wanted.strategy;
    if (!fits || entrant.robots != wanted.robots) continue;
    if (wanted.radio.empty()) wanted.radio = entrant.radio;
    if (entrant.radio == wanted.radio) found.push_back(entrant);
  }
  return found;
}

}  // namespace

std::string name_of_opponents(const Contest& contest) {
  Entrant entrant = contest.b.front();
  if (contest.b.size() > 1) entrant.strategy = kBestBaseline;
  return name_of(entrant);
}

std::vector<Entrant> entrants_of(std::span<const std::string> strategies, std::span<const int> robots,
                                 std::span<const std::string> radios) {
  std::vector<Entrant> entrants;
  for (const int n : robots) {
    for (const std::string& strategy : strategies) {
      if (n == 1) entrants.push_back({strategy, n});
    }
    for (const std::string& radio : radios) {
      for (const std::string& strategy : strategies) {
        if (n > 1) entrants.push_back({strategy, n, radio});
      }
    }
  }
  return entrants;
}

types::Result<Contest> parse_contest(const std::string& text, std::span<const Entrant> entrants) {
  const std::string_view whole = text;
  const std::size_t slash = whole.find('/');
  const auto a = parse_entrant(whole.substr(0, slash));
  const auto b = slash == std::string_view::npos ? std::nullopt : parse_entrant(whole.substr(slash + 1));
  if (!a || !b)
    return fail(
        Errc::kInvalidInput,
        fmt::format("--compare: found '{}', expected STRATEGY:ROBOTS[:RADIO]/STRATEGY:ROBOTS[:RADIO]", text));
  const std::vector<Entrant> found_a = find_entrants(*a, entrants), found_b = find_entrants(*b, entrants);
  for (const auto& [wanted, found] : {std::pair(a, &found_a), std::pair(b, &found_b)}) {
    if (found->empty())
      return fail(Errc::kInvalidInput,
                  fmt::format("--compare: {}: found {}:{}, which does not run; expected those of "
                              "--strategies, --robots and --radio",
                              text, wanted->strategy, wanted->robots));
  }
  if (found_a.size() > 1)
    return fail(
        Errc::kInvalidInput,
        fmt::format("--compare: {}: found {} before the slash, expected one strategy", text, a->strategy));
  return Contest{found_a.front(), found_b};
}

std::vector<Contest> usual_contests(std::span<const Entrant> entrants) {
  std::vector<Contest> contests;
  for (const Entrant& first : entrants) {
    if (first.strategy != entrants.front().strategy) continue;
    const Entrant first_radio = find_entrants({first.strategy, first.robots, ""}, entrants).front();
    std::vector<Entrant> baselines;
    for (const Entrant& other : entrants) {
      const bool alike = other.robots == first.robots && other.radio == first.radio;
      if (!alike || other.strategy == first.strategy) continue;
      contests.push_back({first, {other}});
      if (is_baseline(other)) baselines.push_back(other);
    }
    if (baselines.size() > 1) contests.push_back({first, baselines});
    for (const Entrant& other : entrants) {
      if (first.robots > 1 && other.robots == 1 && first == first_radio) contests.push_back({first, {other}});
    }
    if (first != first_radio) contests.push_back({first, {first_radio}});
  }
  return contests;
}

}  // namespace topo::bench
