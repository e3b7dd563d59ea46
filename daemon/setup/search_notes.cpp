// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/search_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace topo::daemon {
namespace {

constexpr const char* kNothing = "nothing answers";
constexpr const char* kUnclear = "something answers, and does not say in time what it is";

/// The complaint without the address at its beginning.
std::string reason_of(const Fruitless& place) {
  if (place.answers) return kUnclear;
  if (place.complaint.empty()) return kNothing;
  const std::string begin = place.address + ": ";
  std::string_view reason = place.complaint;
  while (reason.starts_with(begin)) reason.remove_prefix(begin.size());
  return std::string(reason);
}

}  // namespace

std::vector<std::string> notes_of(std::span<const Fruitless> places) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const Fruitless& place : places) {
    std::string reason = reason_of(place);
    const auto at = std::find_if(reasons.begin(), reasons.end(),
                                 [&](const auto& known) { return known.first == reason; });
    if (at != reasons.end())
      at->second.push_back(place.address);
    else
      reasons.emplace_back(std::move(reason), std::vector{place.address});
  }
  // What nothing is wrong with comes last.
  std::stable_partition(reasons.begin(), reasons.end(), [](const auto& r) { return r.first != kNothing; });
  std::vector<std::string> notes;
  notes.reserve(reasons.size());
  for (const auto& [reason, addresses] : reasons)
    notes.push_back(reason == kNothing ? fmt::format("{} at {}", reason, fmt::join(addresses, ", "))
                                       : fmt::format("{}: {}", fmt::join(addresses, ", "), reason));
  return notes;
}

}  // namespace topo::daemon
