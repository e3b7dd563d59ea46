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
#include "core/types/sector.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::hokuyo {

/// Configuration of one scanner.
struct ConnectionConfig {
  std::string name{};           ///< "front", for messages
  std::string serial_number{};  ///< as reported by VV ("H0902680"); empty: any. A leading 0 equals H.
  bool intensity = false;       ///< stream ME instead of MD
  int skip_scans = 0;           ///< 0..9 scans omitted between two
  bool mirrored = false;        ///< upside down: the beams count clockwise in the scans that are given out
  types::Sectors masks{};       ///< angles of the scans that are given out: beams there are kInvalid
  double stamp_offset_s = 0.0;  ///< added to every stamp (PROTOCOLS section 12: step 0 or rear mark)
};

/// State of the connection; every change is reported once. Each has one cure.
enum class Health {
  kDisconnected,  ///< no line
  kConnecting,
  kWrongDevice,
  kStarting,
  kStreaming,
  kSilent,    ///< a line, and nothing comes
  kLate,      ///< scans wait on their line
  kDamaged,   ///< what it tells of itself comes damaged
  kUnusable,  ///< what it tells of itself is not what can be worked with
  kFault,     ///< by its own word
};

/// Identity and measurement constants, from VV, PP and II.
struct SensorInfo {
  std::string vendor, product, firmware, protocol, serial_number, model, status;
  std::string assumed;  ///< of a model that PROTOCOLS does not list; empty: nothing
  int distance_min_mm = 0, distance_max_mm = 0;
  int steps_per_turn = 0, step_min = 0, step_max = 0, step_front = 0;
  int rpm = 0;
};

/// Counters since the start; every kind of loss has a counter.
struct Counters {
  std::uint64_t scans = 0, checksum_errors = 0, resyncs = 0, reconnects = 0, lost_scans = 0, bytes = 0;
};

enum class StepOutcome {
  kNothing,  ///< no scan within the time-out
  kScan,     ///< `out` holds a scan
  kChanged,  ///< health changed: read health() and message()
};

/// Connection to one Hokuyo sensor, from connect to reconnect: identification, clock synchronisation,
/// streaming, resynchronisation, back-off. Used by one thread. Allocates while connecting, never while
/// streaming.
class Connection {
 public:
  Connection(ConnectionConfig config, std::unique_ptr<io::Connector> connector);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Executes the next step that is due and returns within about `timeout`; `out` is written only when the
  /// outcome is kScan.
  StepOutcome step(types::Scan& out, types::Duration timeout);

  /// Switches the laser off and waits until the line is quiet; bounded by `timeout`.
  void close(types::Duration timeout);

  [[nodiscard]] Health health() const;
  /// One sentence for the operator: the fault and its cure.
  [[nodiscard]] const std::string& message() const;
  [[nodiscard]] const std::optional<SensorInfo>& info() const;
  [[nodiscard]] const Counters& counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace topo::hokuyo
