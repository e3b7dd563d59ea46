// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/radio.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// Reads one item into `params`; false when it is none.
bool read_item(std::string_view item, RadioParams& params) {
  if (item == "perfect") return true;
  if (item == "none") return params.silent = true;
  if (const auto range_m = number_after("range:", item); range_m && *range_m > 0.0) {
    params.range_m = *range_m;
    return true;
  }
  if (const auto loss = number_after("loss:", item); loss && *loss >= 0.0 && *loss < 1.0) {
    params.loss = *loss;
    return true;
  }
  if (const auto delay_s = number_after("delay:", item); delay_s && *delay_s >= 0.0 && *delay_s <= 60.0) {
    params.delay_s = *delay_s;
    return true;
  }
  const std::size_t colon = item.rfind(':');
  const auto from_s = number_after("cut:", item.substr(0, colon));
  const auto to_s = number_after(":", item.substr(std::min(colon, item.size())));
  if (!from_s || !to_s || !(*from_s >= 0.0 && *to_s > *from_s)) return false;
  params.cuts.push_back({*from_s, *to_s});
  return true;
}

}  // namespace

types::Result<RadioParams> parse_radio(const std::string& text) {
  RadioParams params;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    if (!read_item(std::string_view(text).substr(begin, end - begin), params))
      return types::fail(
          types::Errc::kInvalidInput,
          fmt::format(
              "--radio: found '{}', expected perfect, none, or items joined by +: range:M with metres above "
              "0, "
              "loss:P with a share from 0 to below 1, delay:S with seconds up to 60, cut:FROM:TO with "
              "seconds, the later one last",
              text));
    begin = end + 1;
  }
  return params;
}

bool Radio::carries(const types::Vector2& from, const types::Vector2& to, double now_s) {
  const bool lost = random_.uniform() < params_.loss;
  const bool cut = std::ranges::any_of(
      params_.cuts, [&](const RadioCut& c) { return now_s >= c.from_s && now_s < c.to_s; });
  return !params_.silent && !lost && !cut && (to - from).norm() <= params_.range_m;
}

}  // namespace topo::bench
