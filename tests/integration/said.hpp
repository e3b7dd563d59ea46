// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <regex.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/integration/wire_rig.hpp"

namespace topo::test {

/// Where a device answers is another place in every run.
inline std::string without_addresses(std::string words) {
  // POSIX, since g++ 12 warns of std::regex under its sanitizers.
  static const regex_t address = [] {
    regex_t compiled = {};
    if (regcomp(
            &compiled,
            R"( ?\(?((serial|tcp):)?(/tmp/[^ :)]*|127\.0\.0\.1:[0-9]+)\)?(: |, )?|(journal|log)-[0-9TZ.a-z]*: )",
            REG_EXTENDED) != 0)
      std::abort();
    return compiled;
  }();
  regmatch_t found = {};
  for (std::size_t from = 0; regexec(&address, words.c_str() + from, 1, &found, 0) == 0; ++from) {
    from += static_cast<std::size_t>(found.rm_so);
    words.replace(from, static_cast<std::size_t>(found.rm_eo - found.rm_so), " ");
  }
  return words;
}

/// What the daemon said since the blow, each once, in the order of its saying.
class Said {
 public:
  Said() = default;
  explicit Said(std::string words) : words_{std::move(words)} {}

  void listen(WireRig& rig) {
    const Json status = rig.ask("status");
    for (const Json& doubt : status["plausibility"]["doubts"]) add(doubt["found"].get<std::string>());
    const Json health = rig.ask("health");
    for (const Json& fault : health["faults"]) add(fault.get<std::string>());
    const std::string state = status["state"].get<std::string>();
    if (state.starts_with("stopped") || state.starts_with("emergency")) add(state);
    const std::string obstacle = status["session"]["obstacle"].get<std::string>();
    if (!obstacle.empty()) add("session: " + obstacle);
    const std::string reason = status.value("reason", "");  // absent before the first plan
    if (state == "standing" && !reason.empty()) add("plan: " + reason);
  }
  [[nodiscard]] bool has(const std::string& part) const {
    return std::any_of(words_.begin(), words_.end(),
                       [&](const std::string& w) { return w.find(part) != std::string::npos; });
  }
  /// Any of several parts with a bar between them.
  [[nodiscard]] bool has_any(const std::string& parts) const {
    std::istringstream each(parts);
    for (std::string part; std::getline(each, part, '|');)
      if (has(part)) return true;
    return false;
  }
  /// Three of them, what was expected first.
  [[nodiscard]] std::string text(const std::string& expected = "") const {
    constexpr std::size_t kMost = 3;
    std::vector<std::string> order = words_;
    std::stable_partition(order.begin(), order.end(),
                          [&](const std::string& w) { return Said(w).has_any(expected); });
    std::string all;
    for (std::size_t i = 0; i < std::min(kMost, order.size()); ++i) all += (i == 0 ? "" : "; ") + order[i];
    return all.empty() ? "nothing" : all;
  }

 private:
  void add(std::string words) {
    constexpr std::string_view kStopped = "stopped: ";
    words = without_addresses(std::move(words));
    if (words.starts_with(kStopped) && has(words.substr(kStopped.size()))) return;  // a doubt, named already
    for (std::size_t at = words.find("  "); at != std::string::npos; at = words.find("  "))
      words.erase(at, 1);
    if (words.ends_with(": ")) return;  // a device that was not tried yet
    if (has(words)) return;
    std::replace(words.begin(), words.end(), '\n', ' ');
    std::replace(words.begin(), words.end(), '|', '/');
    words_.push_back(std::move(words));
  }
  std::vector<std::string> words_;
};

}  // namespace topo::test
