// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/handshake.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/types/bytes.hpp"
#include "drivers/pioneer/sip.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;

constexpr std::array<int, 5> kBaudOrder{9600, 38400, 19200, 115200, 57600};  // PROTOCOLS section 1.2
// The rate that 9600 baud can carry: on a line that loses a third of its bytes, one in eleven arrives.
constexpr types::Duration kStopAgainUnheard = milliseconds(10);
constexpr types::Duration kQuietTime = milliseconds(200);
constexpr types::Duration kStillStreaming = milliseconds(150);
// Three status cycles: the robot streams them on an open connection whether its host is there or not.
constexpr types::Duration kListenTime = milliseconds(330);
constexpr types::Duration kSyncTime = milliseconds(300);
constexpr types::Duration kFirstStatusTime = milliseconds(400);
constexpr types::Duration kConfigTime = milliseconds(300);
constexpr int kTries = 3;
constexpr int kRestarts = 10;
constexpr std::string_view kTcp = "tcp:";

/// True for a status packet of a standing robot.
bool stands(const PacketView& packet) {
  const auto status = decode_status(packet.payload);
  return status && status->left_velocity == 0 && status->right_velocity == 0;
}

/// A command of the opening, which no robot sends.
bool is_echo_of_opening(const PacketView& packet) {
  const auto is = [&](Command command) { return packet.type() == static_cast<std::uint8_t>(command); };
  return is(Command::kEStop) || is(Command::kVel) || is(Command::kRvel);
}

bool is_reset(const PacketView& packet) {
  return packet.is(PacketType::kReset) || packet.is(PacketType::kResetWithDiagnosis);
}

}  // namespace

Handshake::Handshake(Link& link, ExpectedRobot expected, std::string_view device, int first_baud,
                     types::Stamp may_drive_until, Opening opening)
    : link_(link),
      expected_(std::move(expected)),
      device_(device),
      may_drive_until_(may_drive_until),
      beginning_{.opening = opening, .echoed = false, .heard = false, .heard_robot = false} {
  static_assert(kBaudOrder.size() + 1 == std::tuple_size_v<decltype(bauds_.rates)>,
                "every rate, and the first one");
  if (!link.has_baud()) return;
  if (first_baud != 0) bauds_.rates.at(bauds_.count++) = first_baud;
  for (const int baud : kBaudOrder)
    if (baud != first_baud) bauds_.rates.at(bauds_.count++) = baud;
}

types::Status Handshake::begin() {
  if (bauds_.count > 0) {
    bauds_.current = bauds_.rates[0];
    auto set = link_.set_baud(bauds_.current);
    if (!set) return set;
  }
  if (beginning_.opening == Opening::kSyncAlone && link_.now() >= may_drive_until_)
    enter(Phase::kListening, kListenTime);
  else
    begin_stopping();
  return {};
}

bool Handshake::opening_refused(bool line_lost) const {
  if (!device_.starts_with(kTcp) || beginning_.opening == Opening::kSyncAlone) return false;
  const bool at_the_beginning =
      phase_ == Phase::kQuiet || (phase_ == Phase::kSync && attempts_.sync_index == 0);
  return beginning_.echoed || (line_lost && at_the_beginning && !beginning_.heard);
}

void Handshake::enter(Phase phase, types::Duration wait) {
  phase_ = phase;
  wait_ = wait;
  deadline_ = link_.now() + wait;
}

/// VEL 0 or SYNC0 that arrive where E_STOP was lost would make the robot resume its setpoint instead of
/// stopping it.
Handshake::Progress Handshake::begin_stopping() {
  if (link_.now() >= may_drive_until_) return begin_quiet();
  link_.clear();
  link_.outbox().set_estop();
  enter(Phase::kStopping, kStopAgainUnheard);
  return Progress::kPending;
}

Handshake::Progress Handshake::begin_quiet() {
  beginning_.opening = Opening::kFull;
  Outbox& out = link_.outbox();
  link_.clear();
  out.set_estop();
  out.push(encode(Command::kVel, 0));
  out.push(encode(Command::kRvel, 0));
  out.push(encode(Command::kClose, 1));  // with its argument: without it, a waiting robot takes it for SYNC2
  enter(Phase::kQuiet, kQuietTime);
  return Progress::kPending;
}

Handshake::Progress Handshake::restart(const char* why) {
  if (++attempts_.restarts > kRestarts)
    return fail(Health::kRefuses, device_ + ": " + why + " (" + std::to_string(kRestarts) +
                                      " attempts); switch the robot off and on");
  return begin_quiet();
}

Handshake::Progress Handshake::on_time() {
  if (!link_.all_sent()) {  // the time counts from the last byte sent
    deadline_ = link_.now() + wait_;
    return Progress::kPending;
  }
  if (link_.now() < deadline_) return Progress::kPending;
  switch (phase_) {
    case Phase::kListening:
      send_sync(0);
      return Progress::kPending;
    case Phase::kStopping:
      return begin_stopping();
    case Phase::kQuiet:
      return end_quiet();
    case Phase::kSync:
      return sync_timed_out();
    case Phase::kFirstStatus:
      if (++attempts_.tries >= kTries)
        return fail(Health::kRefuses,
                    device_ + ": " + names_.name + " answers SYNC but sends no status after OPEN");
      send_open();
      return Progress::kPending;
    case Phase::kConfig:
      if (++attempts_.tries >= kTries) return no_config();
      send_config_request();
      return Progress::kPending;
  }
  return Progress::kPending;
}

Handshake::Progress Handshake::end_quiet() {
  if (last_status_ != types::Stamp{} && link_.now() - last_status_ < kStillStreaming)
    return restart("an old connection goes on streaming and does not obey CLOSE");
  attempts_.tries = 0;
  send_sync(0);
  return Progress::kPending;
}

void Handshake::send_sync(unsigned index) {
  attempts_.sync_index = index;
  link_.outbox().push(encode(static_cast<Command>(index)));
  enter(Phase::kSync, kSyncTime);
}

Handshake::Progress Handshake::sync_timed_out() {
  if (++attempts_.tries < kTries) {
    // The packets before may have been lost, and on a connection that is still open SYNC0 is a PULSE.
    if (attempts_.sync_index == 0 && beginning_.opening == Opening::kFull) link_.outbox().set_estop();
    send_sync(attempts_.sync_index);
    return Progress::kPending;
  }
  if (attempts_.sync_index > 0)
    return restart("the robot begins to answer SYNC0, SYNC1, SYNC2 but does not finish");
  return next_baud();
}

Handshake::Progress Handshake::next_baud() {
  if (link_.heard_anything() && foreign_.empty())
    foreign_ = link_.heard() + (bauds_.current == 0 ? "" : " at " + std::to_string(bauds_.current) + " baud");
  if (++bauds_.index >= bauds_.count) return no_answer();
  bauds_.current = bauds_.rates[bauds_.index];
  if (auto set = link_.set_baud(bauds_.current); !set)
    return fail(Health::kDisconnected, set.error().message);
  return begin_stopping();
}

Handshake::Progress Handshake::no_answer() {
  const std::string expected = "; expected a Pioneer that answers SYNC0 with fa fb 03 00 00 00";
  if (!foreign_.empty()) return fail(Health::kWrongDevice, device_ + ": found " + foreign_ + expected);
  const std::string speeds = bauds_.count == 0 ? "" : " at 9600 to 115200 baud";
  return fail(Health::kSilent, device_ + ": nothing answers" + speeds + expected + "; is it switched on?");
}

Handshake::Progress Handshake::on_packet(const PacketView& packet) {
  if (packet.is_status()) last_status_ = packet.last_byte;
  beginning_.heard = true;
  switch (phase_) {
    case Phase::kListening:
      return packet.is_status() ? begin_quiet() : Progress::kPending;
    case Phase::kStopping:
      return stands(packet) ? begin_quiet() : Progress::kPending;
    case Phase::kQuiet:
      return on_quiet_packet(packet);
    case Phase::kSync:
      return on_sync_packet(packet);
    case Phase::kFirstStatus:
      if (is_reset(packet)) return restart("the controller resets at OPEN");
      if (!decode_status(packet.payload)) return Progress::kPending;
      attempts_.tries = 0;
      attempts_.damaged_before = link_.damaged_configs();
      send_config_request();
      return Progress::kPending;
    case Phase::kConfig:
      if (is_reset(packet)) return restart("the controller resets at CONFIG");
      return on_config(packet);
  }
  return Progress::kPending;
}

/// Other packets are answers to what was sent before this connection.
Handshake::Progress Handshake::on_quiet_packet(const PacketView& packet) {
  if (!device_.starts_with(kTcp) || !is_echo_of_opening(packet)) return Progress::kPending;
  beginning_.echoed = true;
  return fail(Health::kConnecting, device_ +
                                       ": takes the opening E_STOP for SYNC, as simulators do; connecting "
                                       "again with SYNC0 alone");
}

Handshake::Progress Handshake::on_sync_packet(const PacketView& packet) {
  if (packet.is_status()) return restart("an old connection goes on streaming and does not obey CLOSE");
  if (is_reset(packet)) return restart("the robot rejects the order of SYNC0, SYNC1, SYNC2");
  if (packet.type() != attempts_.sync_index) return Progress::kPending;
  beginning_.heard_robot = true;
  if (attempts_.sync_index == 2) return on_names(packet);
  attempts_.tries = 0;
  send_sync(attempts_.sync_index + 1);
  return Progress::kPending;
}

Handshake::Progress Handshake::on_names(const PacketView& packet) {
  types::ByteReader in(packet.payload.subspan(1));
  names_.name = in.text();
  names_.robot_class = in.text();
  names_.subclass = in.text();
  if (!names_.subclass.empty()) return judge_names();
  return fail(Health::kWrongDevice, device_ +
                                        ": found an answer to SYNC2 without names (a line that echoes?)" +
                                        "; expected name, class and subclass of a Pioneer");
}

/// Before OPEN: another robot's connection is not opened. A subclass that names a family holds against the
/// configured one, whose factors would be another board's.
Handshake::Progress Handshake::judge_names() {
  const std::string found = device_ + ": found robot \"" + names_.name + "\", class \"" + names_.robot_class +
                            "\", subclass \"" + names_.subclass + "\"; expected ";
  const RobotModel* const told = find_family(names_.subclass);
  const RobotModel* const given = find_model(expected_.family);
  if (told != nullptr && given != nullptr && told != given)
    return fail(Health::kWrongDevice, found + "the family " + expected_.family + " (base.family)");
  model_ = told != nullptr ? told : given;
  if (model_ == nullptr)
    return fail(Health::kWrongDevice,
                found + "one of " + known_families() + "; if its board is like one of these: base.family");
  if (!expected_.chassis.empty() && model_->chassis != expected_.chassis)
    return fail(Health::kWrongDevice, found + "a " + expected_.chassis + " (robot.model)");
  if (!expected_.name.empty() && names_.name != expected_.name)
    return another_robot("\"" + names_.name + "\"", "\"" + expected_.name + "\"");
  attempts_.tries = 0;
  send_open();
  return Progress::kPending;
}

Handshake::Progress Handshake::on_config(const PacketView& packet) {
  config_.packet = decode_config(packet.payload);
  if (!config_.packet) {
    if (packet.is(PacketType::kConfig))
      ++config_.damaged;  // its checksum is right, and its text is cut short
    return Progress::kPending;
  }
  const ConfigPacket& told = *config_.packet;
  if (!expected_.name.empty() && told.name != expected_.name)
    return another_robot("\"" + told.name + "\" (by its CONFIG packet)", "\"" + expected_.name + "\"");
  if (!expected_.serial_number.empty() && told.serial_number != expected_.serial_number)
    return another_robot("\"" + names_.name + "\" with the serial number \"" + told.serial_number + "\"",
                         "the serial number \"" + expected_.serial_number + "\"");
  return Progress::kDone;
}

/// Old firmware does not know CONFIG and is accepted, but not as a robot that is told apart by it.
Handshake::Progress Handshake::no_config() {
  config_.damaged += static_cast<int>(link_.damaged_configs() - attempts_.damaged_before);
  if (expected_.serial_number.empty()) return Progress::kDone;
  const std::string robot = device_ + ": found robot \"" + names_.name + "\"";
  if (config_.damaged > 0)
    return fail(Health::kUnidentified,
                robot + " whose CONFIG packet, with the serial number, came damaged (" +
                    std::to_string(config_.damaged) + " times); expected \"" + expected_.serial_number +
                    "\": mend the line, or leave base.serial_number out");
  return fail(Health::kUnidentified,
              robot + " that does not tell its serial number (no CONFIG packet); expected \"" +
                  expected_.serial_number + "\": is the line bad, or the firmware too old?");
}

Handshake::Progress Handshake::another_robot(const std::string& found, const std::string& expected) {
  return fail(Health::kWrongDevice, device_ + ": found robot " + found + "; expected " + expected +
                                        ": are the cables or addresses of two robots exchanged?");
}

void Handshake::send_open() {
  Outbox& out = link_.outbox();
  out.push(encode(Command::kOpen, 1));
  out.push(encode(Command::kVel, 0));
  out.push(encode(Command::kRvel, 0));
  enter(Phase::kFirstStatus, kFirstStatusTime);
}

void Handshake::send_config_request() {
  link_.outbox().push(encode(Command::kConfig, 1));
  enter(Phase::kConfig, kConfigTime);
}

Handshake::Progress Handshake::fail(Health health, std::string message) {
  failure_ = {health, std::move(message)};
  return Progress::kFailed;
}

}  // namespace topo::pioneer
