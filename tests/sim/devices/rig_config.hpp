// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/se2.hpp"
#include "tests/sim/devices/scip_models.hpp"
#include "tests/sim/difficulty.hpp"
#include "tests/sim/laser.hpp"

namespace topo::sim {

/// The three wires of a robot.
enum class DeviceId : std::uint8_t { kFront = 0, kCoronal = 1, kBase = 2 };
inline constexpr std::size_t kDeviceCount = 3;
inline constexpr std::array<std::string_view, kDeviceCount> kDeviceNames{"front", "coronal", "base"};

/// Address for one device.
struct LinkConfig {
  std::optional<std::uint16_t> tcp_port;  ///< 0: any
  std::filesystem::path pty_link;         ///< used when there is no port
  std::string can_interface{};            ///< used when it is not empty; the base only
  int can_unit = 0;
};

struct RobotConfig {
  std::string model = "p3dx";       ///< p3dx or p3at
  std::optional<types::Se2> start;  ///< none: that of the world
  ScipModel front = ScipModel::kUtm30LxEw;
  ScipModel coronal = ScipModel::kUtm30LxEw;
  int watchdog_ms = 2000;
  double battery_volts = 12.7;
  /// The scanners' mounts, as in config/.
  LaserMount front_mount{0.021, 0.0, 0.30, 0.0, ScanPlane::kLevel, 0.0, false};
  LaserMount coronal_mount{0.10, 0.0, 0.40, 0.0, ScanPlane::kCoronal, 0.0, false};
  std::array<LinkConfig, kDeviceCount> links;
};

struct RigConfig {
  std::vector<RobotConfig> robots;
  Difficulty difficulty;
  std::uint64_t seed = 1;
  std::filesystem::path truth_file;      ///< empty: none; for several robots FILE.0, FILE.1, ...
  std::filesystem::path control_socket;  ///< empty: none
};

/// A robot with all its devices on TCP ports chosen by the system.
[[nodiscard]] RobotConfig tcp_robot();
/// The same with its base on a CAN bus, as unit 0.
[[nodiscard]] RobotConfig can_robot(const std::string& interface);
/// A robot with all its devices on pseudo terminals: links laser_front, laser_coronal and base in `folder`.
[[nodiscard]] RobotConfig pty_robot(const std::filesystem::path& folder);

}  // namespace topo::sim
