// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/hokuyo/connection.hpp"
#include "drivers/hokuyo/identity.hpp"
#include "drivers/hokuyo/line.hpp"
#include "drivers/hokuyo/range_decoder.hpp"
#include "drivers/hokuyo/sensor_clock.hpp"

namespace topo::hokuyo {

/// Of TM0 and TM1. On a line that holds its data for longer nothing else comes up either: BM and the first
/// scan have half a second.
constexpr types::Duration kClockLimit = std::chrono::seconds(1);
constexpr types::Duration kBackoffMin = std::chrono::milliseconds(500);  ///< restored after enough good scans

/// Phase of a connection between two losses of its stream.
enum class Phase : std::uint8_t {
  kBackoff,      ///< no stream; the next attempt is due at deadline
  kOpening,      ///< the connector opens the stream
  kFind,         ///< search for SCIP: QT, SCIP2.0, RS at every line speed
  kLeaveAdjust,  ///< TM2, because QT was refused
  kVersion,      ///< VV
  kParameters,   ///< PP
  kState,        ///< II
  kAdjust,       ///< TM0
  kSample,       ///< TM1
  kAdjusted,     ///< TM2
  kLaser,        ///< BM
  kLaserPause,   ///< the laser spins up; BM again at the deadline
  kStart,        ///< MD or ME
  kStreaming,
  kProbe,         ///< QT after silence or too many bad scans
  kProbeVersion,  ///< VV after kProbe
  kProbeState,    ///< II after kProbeVersion
  kReset,         ///< RS
  kResetVersion,  ///< VV after kReset
  kReboot,        ///< RB, RB
};

/// What the connection reports of itself.
struct Verdict {
  Health health = Health::kDisconnected;
  std::string message;
  bool changed = false;  ///< since the caller's last look
};

/// The phase, its request and its deadline.
struct Pending {
  Phase phase = Phase::kBackoff;
  types::Stamp deadline{};
  RequestText sent;      ///< request whose reply the phase waits for
  types::Stamp asked{};  ///< time of that request
  int tries = 0;         ///< of that request
};

/// Attempts to reach the sensor.
struct Retry {
  types::Duration backoff = kBackoffMin;
  int failures = 0;  ///< consecutive attempts without a scan: only the first is reported
  std::uint64_t connections = 0;
};

/// Position in the search for SCIP: line speed and request.
struct LineSearch {
  std::size_t baud_index = 0;
  std::size_t find_index = 0;
};

/// Faults of a connection: consecutive scans and the measures against silence.
struct Faults {
  int bad_in_a_row = 0;
  int good_in_a_row = 0;
  int late_in_a_row = 0;
  bool clock_in_doubt = false;  ///< the next stream begins with TM1
  int ladder = 0;               ///< measures taken against silence: 0 none, 1 QT and II, 2 RS, 3 RB
  bool faulty = false;          ///< the sensor itself reported a fault
};

/// The stream: its request and the constants that its validated parameters give.
struct StreamPlan {
  Family family = Family::kUnknown;
  bool intensity = false;
  StreamRequest request;
  RangeDecoder decode;
  types::ScanGeometry geometry;
  std::bitset<types::Scan::kMaxBeams> masked;  ///< beams that are not looked at
  types::Duration turn{};                      ///< rotation period of the mirror
  types::Duration first_offset{};              ///< from the sensor's stamp to the first beam
  types::Duration silence_limit{};
};

/// The state machine behind Connection. Every phase has sent one request and waits for its reply or its
/// deadline; no handler waits.
struct Connection::Impl {
  Impl(ConnectionConfig config_in, std::unique_ptr<io::Connector> connector_in);

  // connection.cpp: main loop, opening and loss of the stream
  StepOutcome step(types::Scan& out, types::Duration timeout);
  bool advance(types::Scan& out, types::Stamp until);  ///< true: `out` holds a scan
  void advance_closed(types::Stamp until);
  bool on_event(ScipParser::Event event, types::Scan& out);
  void on_reply();
  void on_timeout();
  void close(types::Duration timeout);
  void enter(Phase phase, std::string_view request, types::Duration limit);
  void lose(Health health, const std::string& why);
  void set_health(Health health, std::string text);
  [[nodiscard]] types::Stamp now() const;
  [[nodiscard]] std::string place() const;

  // connection_connect.cpp: from an open port to the first scan
  void start_finding();
  void find_next();
  void find_step();
  void not_found();
  void on_find_reply();
  void enter_version();
  void on_version();
  void on_parameters();
  void prepare_stream();
  void mark_masked();
  void on_adjust_reply();
  void on_sample();
  void enter_laser();
  void retry_laser();
  void on_laser_reply();
  void on_start_reply();
  void retry_version();
  [[nodiscard]] StreamRequest make_request() const;

  // connection_stream.cpp: scans, silence, faults
  bool on_scan(types::Scan& out);
  void fill(types::Scan& out, const SensorClock::Result& time) const;
  bool is_late(const SensorClock::Result& time);
  void count_gap(const SensorClock::Result& time);
  void on_garbage();
  void on_stream_status();
  void on_silence();
  void probe();
  void on_version_again();
  void after_probe();
  void reset_sensor();
  void reboot_or_reconnect();
  void restart_stream();
  [[nodiscard]] std::string streaming_text() const;

  ConnectionConfig config;
  std::unique_ptr<io::Connector> connector;
  Line line;
  Verdict verdict;
  Pending pending;
  Retry retry;
  LineSearch line_search;
  Faults faults;

  std::optional<SensorInfo> info;
  Counters counters;
  SensorInfo found;  ///< data of VV, PP and II so far
  StreamPlan stream;
  SensorClock clock;
  int samples = 0;  ///< replies to TM1
  types::Stamp laser_deadline{};
  std::optional<std::int64_t> last_device_ms;  ///< of the newest scan of this stream
  std::uint64_t sequence = 0;
};

}  // namespace topo::hokuyo
