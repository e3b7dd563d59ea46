// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "core/types/se2.hpp"

namespace topo::bench {

/// Who explores: a strategy (explore/contender.hpp), how many robots, and what carries their letters
/// (explore/radio.hpp; of one robot it means nothing and stays as it is here).
struct Entrant {
  std::string strategy;
  int robots = 1;
  std::string radio = "perfect";
  friend auto operator<=>(const Entrant&, const Entrant&) = default;
};

/// Everything that the result of one exploration depends on.
struct RunKey {
  std::string world;
  std::string building;  ///< fingerprint of what stands there
  std::string program;   ///< what tells this program from others that may decide otherwise
  Entrant entrant;
  std::uint64_t seed = 1;
  types::Se2 start;
  std::string fidelity, finish;
  double limit_s = 0.0;
};

/// "2 x topometric"; a radio that is not perfect is named.
std::string name_of(const Entrant& entrant);

/// An object whose text is the same for the same key, whenever and wherever it is made.
nlohmann::json json_of(const RunKey& key);

}  // namespace topo::bench
