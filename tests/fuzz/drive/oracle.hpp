// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/fuzz/drive/host.hpp"
#include "tests/fuzz/drive/world.hpp"

namespace topo::fuzz {

/// Compares every decision with the truth. The bounds are the product's own (DESIGN "Motion and safety"),
/// each with what the way from the device adds.
class Oracle {
 public:
  /// After every period. Empty, or what must never be: for people.
  std::string judge(const World& world, const Host& host);

 private:
  [[nodiscard]] static std::string judge_age(const World& world, const Host& host);
  [[nodiscard]] static std::string judge_way(const World& world, const Host& host);
  std::string judge_silence(const World& world, const Host& host);
  std::string judge_lag(const World& world, const Host& host);
  [[nodiscard]] bool is_late(const Host& host) const;
  std::string judge_deaf(const World& world, const Host& host);

  types::Stamp silent_since_{}, deaf_since_{};
  types::Stamp late_since_{}, late_{};  ///< commands: without interruption, and the newest
  std::uint64_t bytes_when_silent_ = 0;
  int excused_ = 0;  ///< collisions while the robot was lied to
};

}  // namespace topo::fuzz
