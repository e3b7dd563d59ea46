// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/types/scan.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::hokuyo {

/// What the configuration says of one scanner.
struct ConnectionConfig {
  std::string name{};           ///< "front", for messages
  std::string serial_number{};  ///< as VV reports it ("H0902680"); empty: any. A leading 0 equals H.
  bool intensity = false;       ///< stream ME instead of MD
  int skip_scans = 0;           ///< 0..9 scans left out between two
  double stamp_offset_s = 0.0;  ///< added to every stamp (PROTOCOLS section 12: step 0 or rear mark)
};

/// Where the connection is; every change is told once.
enum class Health { kDisconnected, kConnecting, kWrongDevice, kStarting, kStreaming, kSilent, kFault };

/// Identity and measuring constants, from VV, PP and II.
struct SensorInfo {
  std::string vendor, product, firmware, protocol, serial_number, model, status;
  int distance_min_mm = 0, distance_max_mm = 0;
  int steps_per_turn = 0, step_min = 0, step_max = 0, step_front = 0;
  int rpm = 0;
};

/// Counters since the start; every loss is counted somewhere.
struct Counters {
  std::uint64_t scans = 0, checksum_errors = 0, resyncs = 0, reconnects = 0, lost_scans = 0, bytes = 0;
};

enum class StepOutcome {
  kNothing,  ///< no scan within the time-out
  kScan,     ///< `out` holds a scan
  kChanged,  ///< health changed: read health() and message()
};

/// One Hokuyo sensor from connect to reconnect: identify, synchronise clocks, stream, resynchronise, back
/// off. Used by one thread. Allocates while connecting, never while streaming.
class Connection {
 public:
  Connection(ConnectionConfig config, std::unique_ptr<io::Connector> connector);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Does the next thing that is due and returns within about `timeout`; `out` is written only when the
  /// outcome is kScan (and may hold half a scan otherwise).
  StepOutcome step(types::Scan& out, types::Duration timeout);

  /// Laser off and the line left quiet; bounded by `timeout`.
  void close(types::Duration timeout);

  [[nodiscard]] Health health() const;
  /// One sentence for a person: what is wrong and what to do.
  [[nodiscard]] const std::string& message() const;
  [[nodiscard]] const std::optional<SensorInfo>& info() const;
  [[nodiscard]] const Counters& counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace topo::hokuyo
