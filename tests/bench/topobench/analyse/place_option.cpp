// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/place_option.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace topo::bench {
namespace {

using Named = std::pair<std::string_view, std::variant<double*, float*, std::uint32_t*>>;

std::vector<Named> names_of(places::PlaceParams& p) {
  return {{"furniture_m", &p.furniture_m},
          {"width_ratio_max", &p.width_ratio_max},
          {"narrow_ratio", &p.narrow_ratio},
          {"wider_power", &p.wider_power},
          {"parallel_share", &p.parallel_share},
          {"wall_share_max", &p.wall_share_max},
          {"small_m2", &p.small_m2},
          {"speck_width_m", &p.speck_width_m},
          {"first.piece_m", &p.first.piece_m},
          {"first.passage_ratio", &p.first.passage_ratio},
          {"density.min", &p.density.min},
          {"density.elsewhere_weight", &p.density.elsewhere_weight},
          {"density.turned_weight", &p.density.turned_weight},
          {"density.steps", &p.density.steps},
          {"corridor.length_ratio", &p.corridor.length_ratio},
          {"corridor.clearance_ratio", &p.corridor.clearance_ratio},
          {"corridor.alongside_ratio", &p.corridor.alongside_ratio},
          {"corner.in_line_min", &p.corner.in_line_min},
          {"corner.spurs_ratio", &p.corner.spurs_ratio},
          {"wall_side.step_m", &p.wall_side.step_m},
          {"wall_side.reach_m", &p.wall_side.reach_m}};
}

}  // namespace

types::Status set_place_param(std::string_view name, double value, places::PlaceParams& params) {
  // None is meant to be larger; lengths in cells stay within their types.
  constexpr double kMost = 1000.0;
  if (!(value > 0.0 && value <= kMost)) {
    return types::fail(
        types::Errc::kInvalidInput,
        fmt::format("--set {}: found {}, expected more than 0 and at most {}", name, value, kMost));
  }
  std::string known;
  for (const auto& [each, field] : names_of(params)) {
    if (each == name) {
      if (std::holds_alternative<std::uint32_t*>(field) && value != std::floor(value)) {
        return types::fail(types::Errc::kInvalidInput,
                           fmt::format("--set {}: found {}, expected a whole number", name, value));
      }
      std::visit([&](auto* of) { *of = static_cast<std::remove_reference_t<decltype(*of)>>(value); }, field);
      return {};
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", each);
  }
  return types::fail(types::Errc::kInvalidInput,
                     fmt::format("--set: found '{}', expected one of {}", name, known));
}

}  // namespace topo::bench
