// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/finish.hpp"

#include <array>
#include <charconv>
#include <cstdio>

namespace topo::exploration {
namespace {

constexpr std::string_view kWorthPrefix = "worth:";

}  // namespace

types::Result<FinishRule> parse_finish(std::string_view text) {
  if (text == "essential") return FinishRule{Finish::kEssential, 0.0};
  if (text == "complete") return FinishRule{Finish::kComplete, 0.0};
  if (text.starts_with(kWorthPrefix)) {
    const std::string_view number = text.substr(kWorthPrefix.size());
    double rate_m2ps = 0.0;
    const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), rate_m2ps);
    const bool is_number = fault == std::errc{} && end == number.data() + number.size();
    if (is_number && rate_m2ps >= kRateMin_m2ps && rate_m2ps <= kRateMax_m2ps)
      return FinishRule{Finish::kWorth, rate_m2ps};
  }
  return types::fail(types::Errc::kInvalidInput,
                     "finish: found '" + std::string(text) + "', expected " + std::string(kFinishForm));
}

std::string to_text(const FinishRule& rule) {
  if (rule.finish == Finish::kEssential) return "essential";
  if (rule.finish == Finish::kComplete) return "complete";
  std::array<char, 32> number{};
  const auto [end, fault] = std::to_chars(number.data(), number.data() + number.size(), rule.rate_m2ps);
  return std::string(kWorthPrefix) + std::string(number.data(), fault == std::errc{} ? end : number.data());
}

}  // namespace topo::exploration
