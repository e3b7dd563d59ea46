// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/radio.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

namespace topo::bench {
namespace {

/// The number after a prefix; nothing when the text is something else.
std::optional<double> number_after(std::string_view prefix, std::string_view text) {
  if (!text.starts_with(prefix)) return std::nullopt;
  text.remove_prefix(prefix.size());
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

types::Result<RadioParams> parse_radio(const std::string& text) {
  RadioParams params;
  if (text == "perfect") return params;
  if (text == "none") {
    params.silent = true;
    return params;
  }
  if (const auto range_m = number_after("range:", text); range_m && *range_m > 0.0) {
    params.range_m = *range_m;
    return params;
  }
  if (const auto loss = number_after("loss:", text); loss && *loss >= 0.0 && *loss < 1.0) {
    params.loss = *loss;
    return params;
  }
  return types::fail(
      types::Errc::kInvalidInput,
      fmt::format("--radio: found '{}', expected perfect, none, range:M with metres above 0, or "
                  "loss:P with a share from 0 to below 1",
                  text));
}

bool Radio::carries(const types::Vector2& from, const types::Vector2& to) {
  const bool lost = random_.uniform() < params_.loss;
  return !params_.silent && !lost && (to - from).norm() <= params_.range_m;
}

}  // namespace topo::bench
