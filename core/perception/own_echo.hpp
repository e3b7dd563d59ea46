// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/types/robot_limits.hpp"
#include "core/types/scan.hpp"
#include "core/types/sector.hpp"

namespace topo::perception {

struct OwnEchoParams {
  double same_m = 0.03;  ///< accuracy of a UTM-30LX below 10 m (PROTOCOLS section 11)
  types::Duration lasting = std::chrono::seconds(5);
};

/// Echoes from within the robot's own outline that never change: a post, a cable, a mount that is not where
/// the configuration says. Allocates nothing.
class OwnEcho {
 public:
  explicit OwnEcho(const OwnEchoParams& params = {}) : params_(params) {}

  /// Takes a scan; one that was taken already has no effect.
  void update(const types::Scan& scan, const types::Se2& T_base_laser, const types::Footprint& footprint);
  /// Bearings from the scanner, from the robot's straight ahead, in whole degrees; the first of several.
  [[nodiscard]] std::optional<types::Sector> sector() const;

 private:
  static constexpr std::size_t kBins = 360;  ///< one a degree
  struct Bin {
    types::Stamp since{};  ///< zero: no echo in the last scan
    double range_m = 0.0;
    bool seen = false;
  };
  [[nodiscard]] bool lasts(const Bin& bin) const;

  OwnEchoParams params_;
  std::array<Bin, kBins> bins_{};
  types::Stamp newest_{};
};

}  // namespace topo::perception
