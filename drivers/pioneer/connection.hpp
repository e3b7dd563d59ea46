// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/se2.hpp"
#include "core/types/wheel_calibration.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::pioneer {

/// Configuration of the base.
struct ConnectionConfig : types::DriveLimits {  // clamped to the model's and the firmware's limits
  std::string expected_chassis;                 ///< "p3dx", "p3at"; empty: any whose family is known
  std::string family;         ///< whose factors hold for a subclass that names none; empty: it is refused
  std::string expected_name;  ///< as in SYNC2 and CONFIG, exactly; empty: any
  std::string expected_serial_number;  ///< as in CONFIG, exactly; empty: any, also a base without CONFIG
  int watchdog_ms = 0;  ///< of a firmware that does not tell it, measured before driving; 0: such is refused
  bool sonar = true;
  bool gyro = true;  ///< the heading by the gyro of a base that has one
  types::WheelCalibration wheels;
  types::Duration status_delay{};  ///< of every status packet, beyond what can be observed (SipDelay)
};

enum class Health {
  kDisconnected,
  kConnecting,
  kWrongDevice,
  kReady,
  kOnTrial,  ///< as kReady, but the given watchdog was not measured yet: it turns on the spot, and no more
  kSilent,   ///< a line, and nothing comes
  kRefuses,  ///< it answers, and does not take up a connection
  kUnidentified,  ///< it does not tell the serial number that is expected
  kUnsafe,
  kReset
};
[[nodiscard]] constexpr bool takes_commands(Health health) {
  return health == Health::kReady || health == Health::kOnTrial;
}

/// Where a firmware's watchdog is known from.
enum class WatchdogSource : std::uint8_t { kTold, kGiven, kMeasured };

/// The robot's names, its CONFIG packet, and the model's table (PROTOCOLS section 6).
struct RobotInfo {
  std::string name, subclass, firmware, serial_number;
  std::string assumed;  ///< of its factors, by its family; empty: nothing
  int watchdog_ms = 0;  ///< 0: unknown, driving is refused
  WatchdogSource watchdog = WatchdogSource::kTold;
  int sip_cycle_ms = 100;
  double v_top_mps = 0.0, omega_top_radps = 0.0;
  double deceleration_top_mps2 = 0.0;  ///< that the firmware permits; 0: unknown
  double low_battery_v = 0.0;
  double track_m = 0.0;  ///< effective, 2 / DiffConvFactor
  double swing_radius_m = 0.0;
  double length_front_m = 0.0, length_rear_m = 0.0, width_m = 0.0;
  /// Poses of the transducers, by the index of BaseState::sonar; the first `sonars` are known. The model's
  /// full set: a transducer that is not fitted never sends a reading.
  std::array<types::Se2, types::BaseState::kMaxSonars> T_base_sonar{};
  std::size_t sonars = 0;
  double sonar_range_max_m = 0.0;  ///< at or beyond: no echo
};

struct Counters {
  std::uint64_t status_packets = 0, bad_packets = 0, lost_packets = 0, reconnects = 0, commands = 0,
                bytes = 0;
  io::BusFaults bus;  ///< over all connections; none when the base is not on a bus
};

enum class StepOutcome {
  kNothing,  ///< the deadline passed
  kState,    ///< `out` holds a new state
  kChanged,  ///< health changed: read health() and message()
};

/// Connection to one Pioneer, from connect to controlled close. The first bytes on every opened port are
/// E_STOP, VEL 0, RVEL 0, CLOSE, then SYNC0; none while the base does not obey. On TCP, where what answers
/// takes these for SYNC (simulators do), the next attempt listens for an open connection and begins with
/// SYNC0. Used by one thread. Allocates while connecting, never while running.
class Connection {
 public:
  Connection(ConnectionConfig config, std::unique_ptr<io::Connector> connector);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Reads input, keeps the connection alive, and returns at a new state, a change, or after `timeout`.
  StepOutcome step(types::BaseState& out, types::Duration timeout);

  /// Sends setpoints now (clamped, paced for the firmware) and feeds the firmware's watchdog. A command that
  /// is not finite becomes a stop. Without a call for 200 ms, step() sends a stop.
  types::Status command(const types::BaseCommand& command);

  /// As BaseCommand::silence of every command, for periods in which none can be sent: while the base does not
  /// obey, a new connection only listens, and closing sends nothing. It ends by false, or by itself when the
  /// base is released.
  void set_silence(bool silence);
  /// How often since the start the base was released: heard, while the connection only listened, with its
  /// motors off; or a reset of its controller was heard.
  [[nodiscard]] std::uint64_t releases() const;

  /// E_STOP, VEL 0, RVEL 0, ENABLE 0, CLOSE; bounded by `timeout`. Nothing towards a base that does not obey.
  void close(types::Duration timeout);

  [[nodiscard]] Health health() const;
  [[nodiscard]] const std::string& message() const;
  [[nodiscard]] const std::optional<RobotInfo>& info() const;
  [[nodiscard]] const Counters& counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace topo::pioneer
