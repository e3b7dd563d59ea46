// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim {

enum class ScipModel { kUtm30Lx, kUtm30LxEw, kUst10Lx, kUst20Lx, kUrg04Lx };

/// Identification and abilities of a model (PROTOCOLS section 11).
struct ScipModelSpec {
  ScipModel model;
  std::string_view name;  ///< as written by a user: UTM-30LX-EW
  std::string_view vendor;
  std::string_view product;
  std::string_view firmware;
  std::string_view protocol;
  std::string_view modl;
  int dmin_mm, dmax_mm;
  int ares, amin, amax, afrt;
  int scan_rpm;
  std::string_view scan_speed;  ///< II SCSP
  std::string_view mesm_idle, mesm_single, mesm_multi;
  std::string_view bit_rate;  ///< II SBPS
  std::string_view stat_good;
  std::uint32_t code_not_measured;  ///< for steps outside AMIN to AMAX
  bool ethernet;                    ///< TCP: RB works, a lost client idles the sensor
  bool scip22;                      ///< error statuses of SCIP 2.2
  bool two_character;               ///< MS and GS
  bool intensity;                   ///< ME
  bool multi_echo;                  ///< ND, NE
  bool time_is_scip;                ///< II TIME in four SCIP characters, else six hexadecimal digits
  bool boots_in_scip11;
  bool sums_to_arrow;           ///< checksum quirk of the UTM-30LX's II lines
  bool wedges_on_unknown_scan;  ///< ME or ND silences the sensor until a power cycle (PROTOCOLS section 13)
  bool serial_speeds;           ///< SS and CR have an effect

  [[nodiscard]] int beams() const { return amax - amin + 1; }
  [[nodiscard]] SimTime period() const { return SimTime{std::chrono::minutes{1}} / scan_rpm; }
};

[[nodiscard]] const ScipModelSpec& scip_model(ScipModel model);
/// Model by the name that a user writes; nothing when there is no such model.
[[nodiscard]] std::optional<ScipModel> find_scip_model(std::string_view name);
/// All names, for messages.
[[nodiscard]] std::string scip_model_names();

}  // namespace topo::sim
