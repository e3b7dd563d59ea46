// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/wire_faults.hpp"

#include <ostream>

namespace topo::test {
namespace {

constexpr double kStaleScan_s = 0.150;    // the greater of this and 2.5 scan periods (DESIGN section 2)
constexpr double kStaleStatus_s = 0.300;  // DESIGN section 2
constexpr double kForEver_s = 1e6;
/// A status packet with its delay (the simulator's fixed difficulty) tells of what happened.
constexpr double kStatus_s = 0.100 + 0.060;

Json command(const char* name, const char* device) { return {{"command", name}, {"device", device}}; }
template <class Value>
Json command(const char* name, const char* device, const char* key, Value value) {
  Json json = command(name, device);
  json[key] = value;
  return json;
}

std::uint64_t count(const Evidence& e, const char* device, const char* counter) {
  return e.status["devices"][device]["counters"][counter].get<std::uint64_t>();
}

template <const char* kDevice>
bool is_lost(const Evidence&, const Evidence& now) {
  return now.status["devices"][kDevice]["working"] == false;
}
/// Spoilt bytes show as wrong sums, as a search for the next header, or, when they spoil an answer that the
/// session needs, as a new connection.
template <const char* kDevice>
bool has_spoilt_bytes(const Evidence& before, const Evidence& now) {
  const auto grew = [&](const char* counter) {
    return count(now, kDevice, counter) > count(before, kDevice, counter);
  };
  return grew("checksum_errors") || grew("resyncs") || grew("reconnects");
}
/// The daemon cannot tell a set clock from a late link at once; the device's own counter shows the step. It
/// is as long as the scanner has been on, which is a second when the fault before this one ended with its
/// reset.
template <std::size_t kLaser>
bool has_stepped(const Evidence& before, const Evidence& now) {
  constexpr double kStep_s = 0.1;  // 100 ppm of a minute are 0.006 s
  const double device_s =
      1e-3 * (static_cast<double>(now.moment.laser_ms[kLaser]) - before.moment.laser_ms[kLaser]);
  return std::abs(device_s - (now.moment.truth.sim_s - before.moment.truth.sim_s)) > kStep_s;
}
/// More bytes than status packets hold, 37 and three for each of the three or four echoes of a cycle; what
/// has no header is no bad packet.
bool has_more_bytes(const Evidence& before, const Evidence& now) {
  const auto grown = [&](const char* counter) {
    return count(now, "base", counter) - count(before, "base", counter);
  };
  return grown("bytes") > 100 * grown("status_packets") + 1000;
}
bool has_bad_packets(const Evidence& before, const Evidence& now) {
  return count(now, "base", "bad_packets") > count(before, "base", "bad_packets");
}

constexpr char kFront[] = "front";
constexpr char kCoronal[] = "coronal";
constexpr char kBase[] = "base";

/// What a scanner and its wire can suffer; `stops` says what losing its scans means.
template <const char* kDevice, std::size_t kLaser>
std::vector<WireFault> laser_faults(Outcome stops) {
  const auto laser = [](const char* name) { return command(name, kDevice); };
  const auto with = [](const char* name, const char* key, auto value) {
    return command(name, kDevice, key, value);
  };
  constexpr auto kAlong = Outcome::kDrivesOn;
  const Outcome perhaps = stops == kAlong ? kAlong : Outcome::kTouchesNothing;
  return {
      {"silence",
       {with("silence", "seconds", kForEver_s)},
       {with("silence", "seconds", 0.0)},
       stops,
       kStaleScan_s,
       is_lost<kDevice>},
      {"garbage_of_some_bytes", {with("garbage", "bytes", 5000)}, {}, kAlong, 0.0, has_spoilt_bytes<kDevice>},
      {"garbage_in_a_flood",
       {with("garbage", "bytes", 1'000'000)},
       {},
       perhaps,
       0.0,
       has_spoilt_bytes<kDevice>},
      {"cut", {with("cut", "seconds", 2.5)}, {}, stops, kStaleScan_s, is_lost<kDevice>},
      {"slow_to_one_scan_in_ten",
       {with("slow", "bytes_per_s", 15'000.0)},
       {with("slow", "bytes_per_s", 0.0)},
       stops,
       kStaleScan_s,
       is_lost<kDevice>},
      {"slow_to_one_scan_in_three",
       {with("slow", "bytes_per_s", 50'000.0)},
       {with("slow", "bytes_per_s", 0.0)},
       perhaps,
       0.0,
       is_lost<kDevice>},
      {"drop_of_some_bytes_a_scan",
       {with("drop", "rate", 0.01)},
       {with("drop", "rate", 0.0)},
       stops,
       kStaleScan_s,
       has_spoilt_bytes<kDevice>},
      {"drop_of_a_byte_in_ten_scans",
       {with("drop", "rate", 0.00003)},
       {with("drop", "rate", 0.0)},
       kAlong,
       0.0,
       has_spoilt_bytes<kDevice>},
      {"dead_and_silent",
       {with("dead", "mode", "silent")},
       {with("dead", "mode", "good")},
       stops,
       kStaleScan_s,
       is_lost<kDevice>},
      {"dead_with_a_fault",
       {with("dead", "mode", "fault")},
       {with("dead", "mode", "good")},
       stops,
       kStaleScan_s,
       is_lost<kDevice>},
      // A reset sensor streams again before the robot stands; its clock begins anew.
      {"reset", {laser("reset")}, {}, perhaps, 0.0, has_stepped<kLaser>},
      {"clock_jump_ahead", {with("clock-jump", "ms", 60'000.0)}, {}, kAlong, 0.0, has_stepped<kLaser>},
      {"clock_jump_back", {with("clock-jump", "ms", -60'000.0)}, {}, kAlong, 0.0, has_stepped<kLaser>},
  };
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const WireFault& fault) { return out << fault.name; }

std::vector<WireFault> front_faults() { return laser_faults<kFront, 0>(Outcome::kStops); }
/// Nothing that moves the robot looks at the coronal scanner: only the map is poorer without.
std::vector<WireFault> coronal_faults() {
  auto faults = laser_faults<kCoronal, 1>(Outcome::kDrivesOn);
  for (std::size_t i = 1; i < faults.size(); ++i)
    faults[i].box_after = false;  // the same way ahead each time
  return faults;
}

std::vector<WireFault> base_faults() {
  const auto with = [](const char* name, const char* key, auto value) {
    return command(name, kBase, key, value);
  };
  // With no command getting through it is the firmware that stops, by its watchdog. On a line that loses
  // bytes the last command to move may get through until the daemon knows that it hears nothing.
  constexpr double kUnheard_s = WireRig::kWatchdog_s;
  constexpr double kHalfHeard_s = kStaleStatus_s + WireRig::kWatchdog_s;
  return {
      {"silence",
       {with("silence", "seconds", kForEver_s)},
       {with("silence", "seconds", 0.0)},
       Outcome::kStops,
       kStaleStatus_s,
       is_lost<kBase>},
      {"garbage_of_some_bytes",
       {with("garbage", "bytes", 2000)},
       {},
       Outcome::kDrivesOn,
       0.0,
       has_more_bytes},
      {"garbage_in_a_flood",
       {with("garbage", "bytes", 100'000)},
       {},
       Outcome::kTouchesNothing,
       0.0,
       has_bad_packets},
      {"cut_shorter_than_the_watchdog",
       {with("cut", "seconds", 0.7)},
       {},
       Outcome::kStops,
       kUnheard_s,
       is_lost<kBase>},
      {"cut_longer_than_the_watchdog",
       {with("cut", "seconds", 4.0)},
       {},
       Outcome::kStops,
       kUnheard_s,
       is_lost<kBase>},
      {"slow",
       {with("slow", "bytes_per_s", 60.0)},
       {with("slow", "bytes_per_s", 0.0)},
       Outcome::kStops,
       kStaleStatus_s,
       is_lost<kBase>},
      {"drop_of_a_third",
       {with("drop", "rate", 0.3)},
       {with("drop", "rate", 0.0)},
       Outcome::kStops,
       kHalfHeard_s,
       is_lost<kBase>},
      {"reset", {command("reset", kBase)}, {}, Outcome::kStops, kStatus_s, is_lost<kBase>},
      {"rear_bumper",
       {{{"command", "bumper"}, {"rear", 2}, {"seconds", kForEver_s}}},
       {{{"command", "bumper"}, {"seconds", 0.0}}},
       Outcome::kStops,
       kStatus_s,
       [](const Evidence&, const Evidence& now) { return now.status["bumpers"]["rear"] == 2; }},
  };
}

double stopping_distance_m(double v_mps, double noticed_s, double late_s) {
  constexpr double kPeriod_s = 0.050, kCommand_s = 0.050, kError_m = 0.05;
  return v_mps * (noticed_s + kPeriod_s + kCommand_s + 2.0 * late_s) +
         v_mps * v_mps / (2.0 * WireRig::kDeceleration_mps2) + kError_m;
}

}  // namespace topo::test
