// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/pioneer/config_packet.hpp"
#include "drivers/pioneer/connection.hpp"
#include "drivers/pioneer/link.hpp"
#include "drivers/pioneer/robot_models.hpp"

namespace topo::pioneer {

/// The robot that must answer; an empty text accepts any.
struct ExpectedRobot {
  std::string chassis, name, serial_number;
  std::string family;  ///< of a robot whose subclass names none (ConnectionConfig)
};

/// From an open port to an open connection with a known robot (PROTOCOLS sections 2 and 7): a state machine
/// with deadlines that never blocks. The first bytes at every speed are E_STOP, VEL 0, RVEL 0, CLOSE: a robot
/// that lost its host resumes its last setpoint on any packet. On a line that loses bytes, any one of them
/// may be the only one to arrive; therefore a robot that may still drive is sent only E_STOP until it reports
/// standstill or its watchdog must have expired.
///
/// A simulator (AMRISim) takes the first bytes for wrong SYNCs: it echoes them or closes the connection. Such
/// a refusal is told, and the next attempt may begin with kSyncAlone: nothing is sent while status packets
/// could show an open connection, which would get the full opening; then SYNC0.
class Handshake {
 public:
  enum class Progress { kPending, kDone, kFailed };
  enum class Opening { kFull, kSyncAlone };

  /// A robot other than `expected` ends in kFailed with kWrongDevice; so does, with kUnidentified, one that
  /// does not tell its serial number while one is expected. `first_baud` is tried before the other speeds; 0:
  /// unknown. Until `may_drive_until` the robot may still follow a setpoint of a lost connection; kSyncAlone
  /// has no effect until then.
  Handshake(Link& link, ExpectedRobot expected, std::string_view device, int first_baud,
            types::Stamp may_drive_until = {}, Opening opening = Opening::kFull);

  /// Sets the first speed and queues the first bytes.
  types::Status begin();
  Progress on_packet(const PacketView& packet);
  /// Handles expired deadlines.
  Progress on_time();
  [[nodiscard]] types::Stamp deadline() const { return deadline_; }

  /// True after the robot has answered SYNC0.
  [[nodiscard]] bool heard_robot() const { return beginning_.heard_robot; }
  [[nodiscard]] int baud() const { return bauds_.current; }
  [[nodiscard]] const std::string& name() const { return names_.name; }
  [[nodiscard]] const std::string& subclass() const { return names_.subclass; }
  [[nodiscard]] const RobotModel& model() const { return *model_; }
  [[nodiscard]] const ConfigAnswer& config() const { return config_; }
  /// True on TCP when the full opening was echoed, or when the line was lost after it before a packet was
  /// heard: so do simulators, and no robot.
  [[nodiscard]] bool opening_refused(bool line_lost) const;
  /// Valid after kFailed.
  [[nodiscard]] Health failure() const { return failure_.health; }
  [[nodiscard]] const std::string& message() const { return failure_.message; }

 private:
  /// The line speeds in the order in which they are tried; none on a line without a speed.
  struct Bauds {
    std::array<int, 6> rates{};
    std::size_t count = 0;
    std::size_t index = 0;
    int current = 0;
  };
  /// As SYNC2 tells them.
  struct Names {
    std::string name, robot_class, subclass;
  };
  struct Failure {
    Health health = Health::kSilent;
    std::string message;
  };
  struct Attempts {
    unsigned sync_index = 0;
    int tries = 0;  ///< of what the phase waits for
    int restarts = 0;
    std::uint64_t damaged_before = 0;  ///< Link::damaged_configs() at the first request
  };
  /// How the connection begins, and what was heard of it.
  struct Beginning {
    Opening opening = Opening::kFull;
    bool echoed = false;
    bool heard = false;        ///< any packet
    bool heard_robot = false;  ///< it answered SYNC0
  };
  enum class Phase { kListening, kStopping, kQuiet, kSync, kFirstStatus, kConfig };

  void enter(Phase phase, types::Duration wait);
  Progress begin_stopping();
  Progress begin_quiet();
  Progress on_quiet_packet(const PacketView& packet);
  Progress restart(const char* why);
  Progress end_quiet();
  void send_sync(unsigned index);
  Progress sync_timed_out();
  Progress next_baud();
  Progress no_answer();
  Progress on_sync_packet(const PacketView& packet);
  Progress on_names(const PacketView& packet);
  Progress judge_names();
  Progress on_config(const PacketView& packet);
  Progress no_config();
  Progress another_robot(const std::string& found, const std::string& expected);
  void send_open();
  void send_config_request();
  Progress fail(Health health, std::string message);

  Link& link_;
  ExpectedRobot expected_;
  std::string device_;
  Bauds bauds_;
  types::Stamp may_drive_until_;
  Beginning beginning_;

  Phase phase_ = Phase::kQuiet;
  types::Duration wait_{};
  types::Stamp deadline_{};
  types::Stamp last_status_{};
  Attempts attempts_;
  std::string foreign_;  ///< first received bytes that were not ARCOS, with their speed

  Names names_;
  const RobotModel* model_ = nullptr;
  ConfigAnswer config_;
  Failure failure_;
};

}  // namespace topo::pioneer
