// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/key_table.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "core/types/watchdog.hpp"
#include "daemon/config/masks.hpp"
#include "daemon/config/polygon.hpp"
#include "daemon/config/pose.hpp"
#include "drivers/pioneer/robot_models.hpp"

namespace topo::daemon {
namespace {

/// The field given by member pointers, as a plain function: at<&Configuration::base, &BaseConfig::v_max_mps>.
template <auto... Members>
auto& at(Configuration& configuration) {
  return (configuration.*....*Members);
}

template <auto Section, auto Field>
void set_choice(Configuration& configuration, std::size_t index) {
  auto& field = configuration.*Section.*Field;
  field = static_cast<std::remove_reference_t<decltype(field)>>(index);
}

template <auto Section, auto Field>
std::size_t get_choice(const Configuration& configuration) {
  return static_cast<std::size_t>(configuration.*Section.*Field);
}

template <auto Section, auto Field>
ChoiceKey choice(std::span<const std::string_view> names) {
  return {&set_choice<Section, Field>, &get_choice<Section, Field>, names};
}

// In the order of the enumerations.
constexpr std::array<std::string_view, 2> kModels{"p3dx", "p3at"};
constexpr std::array<std::string_view, 5> kLevels{"trace", "debug", "info", "warning", "error"};
constexpr std::array<std::string_view, 2> kLooks{"everybody", "token"};
constexpr std::array<std::string_view, 3> kPolicies{"enforce", "try", "off"};

bool all_of(std::string_view text, std::size_t max, std::string_view extra) {
  return !text.empty() && text.size() <= max && std::all_of(text.begin(), text.end(), [extra](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           extra.find(c) != std::string_view::npos;
  });
}

bool is_name(std::string_view text) { return all_of(text, 32, "-_"); }
bool is_finish(std::string_view text) { return exploration::parse_finish(text).has_value(); }
bool is_serial_number(std::string_view text) { return text.empty() || all_of(text, 16, "-_."); }
bool is_told_text(std::string_view text) {
  return text.size() <= 32 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}
bool is_family(std::string_view text) { return text.empty() || pioneer::find_model(text) != nullptr; }
bool is_group(std::string_view text) { return all_of(text, 32, "-_") && text.front() != '-'; }
bool is_absolute(std::string_view text) {
  return text.size() > 1 && text.size() < 4096 && text.front() == '/' && text.back() != '/' &&
         text.find('\0') == std::string_view::npos;
}
bool is_resume(std::string_view text) { return text.empty() || all_of(text, 64, "-_"); }
bool is_optional_path(std::string_view text) { return text.empty() || is_absolute(text); }
// sockaddr_un.sun_path holds 108 bytes including the terminating zero.
bool is_socket_path(std::string_view text) { return is_absolute(text) && text.size() < 108; }

// IFNAMSIZ with its terminating zero; the kernel refuses "/" and white space. What is left goes into an XML
// text.
bool is_interface(std::string_view text) { return all_of(text, 15, "-_.:@"); }
/// Numbers only: a name would be looked up when the radio comes up, which takes seconds without a name
/// server.
bool is_peer(std::string_view text) {
  in_addr address{};
  if (::inet_pton(AF_INET, std::string(text).c_str(), &address) != 1) return false;
  const std::uint32_t first = ntohl(address.s_addr) >> 24U;
  return first > 0 && first < 224;  // neither "this network", nor multicast and beyond
}
bool is_security(std::string_view text) { return text == "off" || is_absolute(text); }

bool is_address(std::string_view text) {
  const std::string address(text);
  in6_addr bytes{};
  return ::inet_pton(AF_INET, address.c_str(), &bytes) == 1 ||
         ::inet_pton(AF_INET6, address.c_str(), &bytes) == 1;
}
bool is_host_name(std::string_view text) { return all_of(text, 253, "-."); }

constexpr std::string_view kToldForm =
    "up to 32 printable characters as the robot tells them, or \"\" for any";
constexpr std::string_view kFamilyForm =
    "p3dx-sh, p3at-sh, p3atiw-sh, p3dx, p3at, p2d8+, p2at8+, p2dx or p2at, or \"\" for none";
constexpr std::string_view kPathForm = "an absolute path of a file, or \"\" for none";

/// A team is small; every address costs a datagram a second to where nobody may be.
constexpr std::size_t kPeersMax = 16;
constexpr std::size_t kHostsMax = 16;
/// The ports of a domain begin at 7400 + 250 * domain (DDSI-RTPS 2.3, 9.6.1.1) and must be below 65536.
constexpr int kDomainMax = 230;

void add_robot(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::robot;
  using C = RobotConfig;
  t.push_back({"robot.name", "", false,
               TextKey{&at<kS, &C::name>, "1 to 32 letters, digits, - and _", &is_name},
               "what the robot is called in messages and files"});
  t.push_back({"robot.model", "", true, choice<kS, &C::model>(kModels),
               "the Pioneer's model; a base that names itself otherwise is refused"});
  t.push_back({"robot.id", "", false, IntegerKey{&at<kS, &C::id>, 1, 250},
               "number of the robot, unique in its team"});
  t.push_back({"robot.length_front_m", "m", false, RealKey{&at<kS, &C::length_front_m>, 0.0, 1.0},
               "hull ahead of the centre of rotation with everything bolted on; 0: as the model"});
  t.push_back({"robot.length_rear_m", "m", false, RealKey{&at<kS, &C::length_rear_m>, 0.0, 1.0},
               "hull behind the centre of rotation; 0: as the model"});
  t.push_back({"robot.width_m", "m", false, RealKey{&at<kS, &C::width_m>, 0.0, 1.5},
               "hull from left to right; 0: as the model"});
}

void add_base(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::base;
  using C = BaseConfig;
  t.push_back({"base.address", "", true, AddressKey{&at<kS, &C::address>, true},
               "where the Pioneer's controller answers"});
  t.push_back({"base.name", "", false, TextKey{&at<kS, &C::name>, kToldForm, &is_told_text},
               "name that the controller must tell (SYNC2, CONFIG), exactly; \"\": any"});
  t.push_back({"base.serial_number", "", false, TextKey{&at<kS, &C::serial_number>, kToldForm, &is_told_text},
               "serial number that the controller must tell (CONFIG), exactly; \"\": any"});
  t.push_back(
      {"base.family", "", false, TextKey{&at<kS, &C::family>, kFamilyForm, &is_family},
       "whose factors hold for a controller whose subclass names no known board; \"\": it is refused"});
  t.push_back(
      {"base.watchdog_ms", "ms", false,
       IntegerKey{&at<kS, &C::watchdog_ms>, 0, static_cast<int>(types::kWatchdogMax.count())},
       "watchdog of a firmware that does not tell it, measured with the first turn by hand; 0: such a "
       "base is not driven"});
  t.push_back({"base.v_max_mps", "m/s", false, RealKey{&at<kS, &C::v_max_mps>, 0.05, 2.0},
               "forward speed never exceeded"});
  t.push_back({"base.omega_max_radps", "rad/s", false, RealKey{&at<kS, &C::omega_max_radps>, 0.1, 5.0},
               "turning speed never exceeded"});
  t.push_back({"base.acceleration_mps2", "m/s2", false, RealKey{&at<kS, &C::acceleration_mps2>, 0.05, 2.0},
               "change of speed when speeding up"});
  t.push_back({"base.deceleration_mps2", "m/s2", false, RealKey{&at<kS, &C::deceleration_mps2>, 0.1, 2.0},
               "change of speed when braking; the stopping distance is computed with it"});
  t.push_back({"base.angular_acceleration_radps2", "rad/s2", false,
               RealKey{&at<kS, &C::angular_acceleration_radps2>, 0.1, 6.0}, "change of turning speed"});
  t.push_back({"base.sonar", "", false, SwitchKey{&at<kS, &C::sonar>}, "sonar rings switched on"});
  t.push_back({"base.gyro", "", false, SwitchKey{&at<kS, &C::gyro>},
               "the heading by the gyro of a base that reports one (P3-AT), in place of the wheels'"});
  using W = types::WheelCalibration;
  t.push_back({"base.wheel_left", "", false, RealKey{&at<kS, &C::wheels, &W::left>, 0.8, 1.25},
               "true travel of the left wheel per travel that the firmware counts (topoctl calibrate)"});
  t.push_back({"base.wheel_right", "", false, RealKey{&at<kS, &C::wheels, &W::right>, 0.8, 1.25},
               "the same of the right wheel"});
  t.push_back({"base.track_m", "m", false, RealKey{&at<kS, &C::wheels, &W::track_m>, 0.0, 1.0},
               "effective track of the wheels (topoctl calibrate); 0: as the model"});
  t.push_back({"base.status_delay_s", "s", false, RealKey{&at<kS, &C::status_delay_s>, -0.1, 0.2},
               "how much older than they look status packets are, against scans (topoctl calibrate)"});
}

template <auto kS>
void add_scanner(std::vector<KeySpec>& t, const std::string& section, bool coronal) {
  using C = ScannerConfig;
  const auto key = [&section](const char* name) { return section + "." + name; };
  t.push_back({key("address"), "", true, AddressKey{&at<kS, &C::address>}, "where the Hokuyo answers"});
  t.push_back(
      {key("serial_number"), "", false,
       TextKey{&at<kS, &C::serial_number>,
               "up to 16 letters and digits as the sensor reports it (\"H0902680\")", &is_serial_number},
       "serial number the sensor must report; \"\": any (refused for two sensors on serial devices)"});
  t.push_back({key("x_m"), "m", false, RealKey{&at<kS, &C::x_m>, -1.0, 1.0},
               "place of the sensor ahead of the centre of rotation"});
  t.push_back(
      {key("y_m"), "m", false, RealKey{&at<kS, &C::y_m>, -1.0, 1.0}, "place of the sensor to the left"});
  t.push_back(
      {key("z_m"), "m", false, RealKey{&at<kS, &C::z_m>, 0.0, 3.0}, "height of the sensor above the floor"});
  if (coronal) {
    t.push_back({key("roll_rad"), "rad", false, RealKey{&at<kS, &C::roll_rad>, -3.15, 3.15},
                 "turn of the sensor's zero beam from straight up towards the robot's left"});
    t.push_back({key("mirrored"), "", false, SwitchKey{&at<kS, &C::mirrored>},
                 "the sensor's beams run from the robot's left to its right over its top"});
  } else {
    t.push_back(
        {key("yaw_rad"), "rad", false, RealKey{&at<kS, &C::yaw_rad>, -3.15, 3.15},
         "turn of the sensor's zero beam from straight ahead, counter-clockwise seen from above; the forward "
         "sector must stay in view"});
    t.push_back({key("roll_rad"), "rad", false, RealKey{&at<kS, &C::roll_rad>, -3.15, 3.15},
                 "turn of the sensor about its zero beam: 0 upright, 3.1416 upside down"});
    t.push_back({key("mirrored"), "", false, SwitchKey{&at<kS, &C::mirrored>},
                 "the sensor's beams run clockwise seen from above: mounted upside down"});
  }
  t.push_back({key("masks_deg"), "deg", false, SectorsKey{&at<kS, &C::masks>},
               coronal
                   ? "sectors not looked at, from straight up towards the robot's left: its own posts"
                   : "sectors not looked at, counter-clockwise from straight ahead: the robot's own posts"});
  t.push_back({key("intensity"), "", false, SwitchKey{&at<kS, &C::intensity>},
               "stream intensities too (ME instead of MD): half as much again on the wire"});
  t.push_back({key("skip_scans"), "", false, IntegerKey{&at<kS, &C::skip_scans>, 0, 9},
               "scans left out between two, for a slow line"});
  t.push_back({key("stamp_offset_s"), "s", false, RealKey{&at<kS, &C::stamp_offset_s>, -0.1, 0.1},
               "added to every stamp, where a model stamps the rear mark and not the first beam"});
}

void add_mapping(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::mapping;
  using P = slam::MapperParams;
  t.push_back({"mapping.resolution_m", "m", false,
               RealKey{&at<kS, &P::grid, &slam::GridParams::resolution_m>, 0.02, 0.2},
               "side of a cell of the map"});
  t.push_back({"mapping.range_max_m", "m", false,
               RealKey{&at<kS, &P::cloud, &slam::CloudParams::range_max_m>, 2.0, 100.0},
               "beams of the front scanner beyond are no evidence"});
  t.push_back({"mapping.keyframe_travel_m", "m", false,
               RealKey{&at<kS, &P::keyframe, &slam::KeyframeParams::travel_m>, 0.05, 3.0},
               "way after which a scan becomes a keyframe"});
  t.push_back({"mapping.keyframe_turn_rad", "rad", false,
               RealKey{&at<kS, &P::keyframe, &slam::KeyframeParams::turn_rad>, 0.05, 1.6},
               "turn after which a scan becomes a keyframe"});
  t.push_back({"mapping.loop_radius_m", "m", false,
               RealKey{&at<kS, &P::loop, &slam::LoopParams::radius_m>, 1.0, 50.0},
               "old keyframes this near, plus the drift, are tried for loop closures"});
  t.push_back({"mapping.odometry_wait_s", "s", false, RealKey{&at<kS, &P::odometry_wait_s>, 0.0, 1.0},
               "how long a scan waits for the odometry after it"});
  t.push_back({"mapping.odometry_error_per_m", "m/m", false,
               RealKey{&at<kS, &P::motion, &slam::MotionNoise::trans_per_m>, 0.001, 1.0},
               "standard deviation of dead reckoning in distance"});
  t.push_back({"mapping.odometry_error_per_rad", "rad/rad", false,
               RealKey{&at<kS, &P::motion, &slam::MotionNoise::rot_per_rad>, 0.001, 1.0},
               "standard deviation of dead reckoning in turning"});
  t.push_back({"mapping.height_min_m", "m", false,
               RealKey{&at<kS, &P::coronal, &walls::CoronalMount::height_min_m>, 0.0, 1.0},
               "what the coronal scanner sees below is floor"});
  t.push_back({"mapping.height_max_m", "m", false,
               RealKey{&at<kS, &P::coronal, &walls::CoronalMount::height_max_m>, 0.5, 3.2},
               "what the coronal scanner sees above is ceiling"});
  t.push_back({"mapping.coronal_range_max_m", "m", false,
               RealKey{&at<kS, &P::coronal, &walls::CoronalMount::range_max_m>, 1.0, 60.0},
               "beams of the coronal scanner beyond are no evidence"});
}

void add_exploration(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::exploration;
  using C = ExplorationConfig;
  t.push_back({"exploration.strategy", "", false, choice<kS, &C::strategy>(exploration::strategy_names()),
               "topometric: a handful of goals from the places; nearest_frontier: always the nearest edge of "
               "unknown space; the others share such edges out among a team"});
  t.push_back(
      {"exploration.finish", "", false, TextKey{&at<kS, &C::finish>, exploration::kFinishForm, &is_finish},
       "essential: home when no essential goal is left, nor a gap onto a room; worth:RATE: what gives "
       "less than RATE m2 for a second of the way there is left out; complete: all gaps, and a look "
       "into what it cannot enter"});
  t.push_back({"exploration.planning_period_s", "s", false, RealKey{&at<kS, &C::planning_period_s>, 0.1, 0.8},
               "from one decision to the next"});
  t.push_back({"exploration.frontier_min_m", "m", false, RealKey{&at<kS, &C::frontier_min_m>, 0.1, 3.0},
               "narrower edges of unknown space are nobody's goal"});
  t.push_back({"exploration.goal_reached_m", "m", false, RealKey{&at<kS, &C::goal_reached_m>, 0.1, 3.0},
               "an exploration goal counts as visited from here"});
  t.push_back({"exploration.home_reached_m", "m", false, RealKey{&at<kS, &C::home_reached_m>, 0.05, 1.0},
               "the robot is home this near to its start"});
  t.push_back({"exploration.goal_give_up_s", "s", false, RealKey{&at<kS, &C::goal_give_up_s>, 1.0, 3600.0},
               "a goal that was given up comes back after this"});
  t.push_back({"exploration.battery_home_v", "V", false, RealKey{&at<kS, &C::battery_home_v>, 0.0, 60.0},
               "below this voltage for 10 s the robot goes home; 0: never"});
  t.push_back({"exploration.charge_home", "", false, RealKey{&at<kS, &C::charge_home>, 0.0, 1.0},
               "the same for the state of charge, where the robot reports one; 0: never"});
  t.push_back(
      {"exploration.save_folder", "", false,
       TextKey{&at<kS, &C::save_folder>, "an absolute path of a folder, or \"\" for none", &is_optional_path},
       "where the map is saved when a mission is done; \"\": only \"map save\" saves"});
}

void add_area(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::area;
  using A = types::AreaLimits;
  t.push_back({"area.keep_in_m", "m", false, PolygonKey{&at<kS, &A::keep_in>},
               "corners around where the robot may be, from its start; []: anywhere"});
  t.push_back({"area.keep_out_m", "m", false, PolygonListKey{&at<kS, &A::keep_out>},
               "areas that the robot must not enter, each by its corners: stairs, glass"});
}

void add_motion(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::motion;
  using C = MotionConfig;
  t.push_back({"motion.margin_m", "m", false, RealKey{&at<kS, &C::margin_m>, 0.02, 0.5},
               "kept free around the hull; the robot stops before less is left"});
  t.push_back(
      {"motion.passage_radius_m", "m", false, RealKey{&at<kS, &C::passage_radius_m>, 0.0, 1.0},
       "routes keep this far from everything; 0: room to turn on the spot, less in a door that is the only "
       "way"});
}

void add_plausibility(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::plausibility;
  using P = plausibility::PlausibilityParams;
  using Picture = plausibility::PictureParams;
  t.push_back({"plausibility.open_space", "", false, SwitchKey{&at<kS, &P::picture, &Picture::open_space>},
               "true: nothing within the scanner's range is normal here; false: the robot stops for it"});
  t.push_back({"plausibility.noiseless", "", false, SwitchKey{&at<kS, &P::picture, &Picture::noiseless>},
               "true: a simulator without noise, equal scans are normal; false: the robot stops for ten"});
}

void add_control_and_log(std::vector<KeySpec>& t) {
  constexpr auto kC = &Configuration::control;
  constexpr auto kL = &Configuration::log;
  t.push_back(
      {"control.socket", "", false,
       TextKey{&at<kC, &ControlConfig::socket>, "an absolute path of less than 108 bytes", &is_socket_path},
       "Unix socket that topoctl talks to"});
  t.push_back(
      {"control.group", "", false,
       TextKey{&at<kC, &ControlConfig::group>, "a group's name: 1 to 32 letters, digits, - and _", &is_group},
       "members of this group may command, as root and the daemon's own user may"});
  t.push_back({"control.state_folder", "", false,
               TextKey{&at<kC, &ControlConfig::state_folder>,
                       "an absolute path of a folder, or \"\" for none", &is_optional_path},
               "where a latched e-stop is kept, which outlives the daemon; \"\": it is forgotten"});
  t.push_back({"log.level", "", false, choice<kL, &LogConfig::level>(kLevels),
               "the least important message still written"});
  t.push_back({"log.file", "", false, TextKey{&at<kL, &LogConfig::file>, kPathForm, &is_optional_path},
               "file that messages are appended to; \"\": standard error (the journal under systemd)"});
}

void add_realtime_and_record(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::realtime;
  using C = RealtimeConfig;
  t.push_back({"realtime.policy", "", false, choice<kS, &C::policy>(kPolicies),
               "enforce: refuse to start without real-time rights; try: warn and go on; off: do not ask"});
  t.push_back({"realtime.base_priority", "", false, IntegerKey{&at<kS, &C::base_priority>, 1, 98},
               "SCHED_FIFO priority of the base thread"});
  t.push_back({"realtime.scan_priority", "", false, IntegerKey{&at<kS, &C::scan_priority>, 1, 98},
               "SCHED_FIFO priority of the scan threads; below the base thread's"});
  t.push_back({"realtime.cpus", "", false, IntegerListKey{&at<kS, &C::cpus>, 0, 1023},
               "CPUs that the real-time threads run on; []: any"});
  t.push_back({"realtime.lock_memory", "", false, SwitchKey{&at<kS, &C::lock_memory>},
               "lock memory, so that a page fault never delays a real-time thread"});
  t.push_back({"record.folder", "", false,
               TextKey{&at<&Configuration::record, &RecordConfig::folder>,
                       "an absolute path of a folder, or \"\" for none", &is_optional_path},
               "every start records all bytes from the devices into a new file here; --record goes before"});
  t.push_back(
      {"record.quota_mb", "MB", false,
       IntegerKey{&at<&Configuration::record, &RecordConfig::quota_mb>, 0, 100'000'000},
       "this robot's recordings in the folder: the oldest finished ones are removed beyond it; 0: no limit"});
}

void add_session(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::session;
  using C = SessionConfig;
  t.push_back(
      {"session.folder", "", false,
       TextKey{&at<kS, &C::folder>, "an absolute path of a folder, or \"\" for none", &is_optional_path},
       "where sessions are kept, from which mapping can go on; \"\": none are"});
  t.push_back({"session.journal", "", false, SwitchKey{&at<kS, &C::journal>},
               "keep the session while it is made, so that a killed daemon recovers its map"});
  t.push_back({"session.journal_period_s", "s", false, RealKey{&at<kS, &C::journal_period_s>, 0.2, 60.0},
               "from one write of the journal to the next"});
  t.push_back({"session.keep", "", false, IntegerKey{&at<kS, &C::keep>, 1, 1000},
               "journals that are kept; older ones are removed, saved sessions never"});
  t.push_back({"session.quota_mb", "MB", false, IntegerKey{&at<kS, &C::quota_mb>, 0, 100'000'000},
               "all journals together: the oldest finished ones are removed beyond it; 0: no limit"});
  t.push_back(
      {"session.resume", "", false,
       TextKey{&at<kS, &C::resume>, "\"killed\", \"last\", a session's name, or \"\" for none", &is_resume},
       "what to go on with at the start: killed: the last journal when its daemon was killed; last: the last "
       "journal; \"\": a new map"});
}

void add_team(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::team;
  using C = TeamConfig;
  t.push_back({"team.name", "", true,
               TextKey{&at<kS, &C::name>, "1 to 32 letters, digits, - and _", &is_name},
               "the team; robots of another one are not heard"});
  t.push_back({"team.id", "", true, IntegerKey{&at<kS, &C::id>, 1, 250},
               "number of the robot in the team; robot.id is the same"});
  t.push_back({"team.interface", "", true,
               TextKey{&at<kS, &C::interface>, "a network interface's name such as \"wlan0\"", &is_interface},
               "network interface of the radio; the link waits until it is up"});
  t.push_back({"team.peers", "", false,
               TextListKey{&at<kS, &C::peers>, "an IPv4 address such as \"10.0.0.2\"", &is_peer, kPeersMax},
               "addresses of the team-mates, where there is no multicast; []: found by multicast"});
  t.push_back({"team.domain", "", false, IntegerKey{&at<kS, &C::domain>, 0, kDomainMax},
               "DDS domain: the same on every robot of the team"});
  t.push_back({"team.security", "", true,
               TextKey{&at<kS, &C::security>,
                       "the absolute path of a folder made by topometric-team, or \"off\"", &is_security},
               "the robot's credentials; off: who is in reach of the radio can command the team"});
  t.push_back(
      {"team.start", "", false, PoseKey{&at<kS, &C::start>},
       "where the robot starts in the team's common frame: [x in m, y in m, yaw in degrees], or unknown"});
  t.push_back({"team.socket", "", false,
               TextKey{&at<kS, &C::socket>, "an absolute path of less than 108 bytes", &is_socket_path},
               "Unix socket between the daemon and its link, topolink"});
}

void add_view(std::vector<KeySpec>& t) {
  constexpr auto kS = &Configuration::view;
  using C = ViewConfig;
  t.push_back({"view.address", "", false,
               TextKey{&at<kS, &C::address>, "an IP address such as \"127.0.0.1\" or \"::\"", &is_address},
               "where topoview listens; 127.0.0.1: this machine alone reaches the page"});
  t.push_back(
      {"view.port", "", false, IntegerKey{&at<kS, &C::port>, 1, 65535}, "TCP port of the operator's page"});
  t.push_back(
      {"view.hosts", "", false,
       TextListKey{&at<kS, &C::hosts>, "a host's name such as \"robot1.example.org\"", &is_host_name,
                   kHostsMax},
       "names of this robot in browsers, beside its addresses, localhost and the machine's own name"});
  t.push_back({"view.look", "", false, choice<kS, &C::look>(kLooks),
               "who sees the page and may e-stop: everybody that reaches it, or only with a token"});
  t.push_back({"view.state_folder", "", false,
               TextKey{&at<kS, &C::state_folder>, "an absolute path of a folder", &is_absolute},
               "where topoview keeps what proves the tokens (topoview pair)"});
}

std::vector<KeySpec> make_table() {
  std::vector<KeySpec> table;
  add_robot(table);
  add_base(table);
  add_scanner<&Configuration::front>(table, "scanner.front", false);
  add_scanner<&Configuration::coronal>(table, "scanner.coronal", true);
  add_mapping(table);
  add_exploration(table);
  add_area(table);
  add_motion(table);
  add_plausibility(table);
  add_control_and_log(table);
  add_realtime_and_record(table);
  add_session(table);
  add_team(table);
  add_view(table);
  return table;
}

struct ExpectedText {
  std::string operator()(const RealKey& k) const {
    return fmt::format("a number from {} to {}", k.min, k.max);
  }
  std::string operator()(const IntegerKey& k) const {
    return fmt::format("a whole number from {} to {}", k.min, k.max);
  }
  std::string operator()(const SwitchKey&) const { return "true or false"; }
  std::string operator()(const TextKey& k) const { return "a string: " + std::string(k.form); }
  std::string operator()(const ChoiceKey& k) const {
    std::string text = "one of";
    for (const auto name : k.names) text += (text.size() == 6 ? " " : ", ") + quoted(name);
    return text;
  }
  std::string operator()(const AddressKey& k) const {
    return k.may_be_can ? "\"serial:/dev/NAME\", \"tcp:HOST:PORT\" or \"can:INTERFACE:UNIT\""
                        : "\"serial:/dev/NAME\" or \"tcp:HOST:PORT\"";
  }
  std::string operator()(const IntegerListKey& k) const {
    return fmt::format("a list of whole numbers from {} to {}", k.min, k.max);
  }
  std::string operator()(const TextListKey& k) const {
    return fmt::format("a list of at most {} strings, each {}", k.longest, k.form);
  }
  std::string operator()(const PoseKey&) const { return std::string(kPoseForm); }
  std::string operator()(const PolygonKey&) const {
    return "corners [[x, y], [x, y], [x, y], ...] of a polygon whose edges do not cross";
  }
  std::string operator()(const PolygonListKey&) const {
    return "a list of polygons [[[x, y], [x, y], [x, y], ...], ...] whose edges do not cross";
  }
  std::string operator()(const SectorsKey&) const { return std::string(kSectorsForm); }
};

/// The shortest text that reads back as the same double; with ".0" where needed, because TOML distinguishes
/// 1.0 from 1.
std::string real_text(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

struct ValueText {
  Configuration& c;
  std::string operator()(const RealKey& k) const { return real_text(k.field(c)); }
  std::string operator()(const IntegerKey& k) const { return std::to_string(k.field(c)); }
  std::string operator()(const SwitchKey& k) const { return k.field(c) ? "true" : "false"; }
  std::string operator()(const TextKey& k) const { return quoted(k.field(c)); }
  std::string operator()(const ChoiceKey& k) const { return quoted(k.names[k.get(c)]); }
  std::string operator()(const AddressKey& k) const { return quoted(k.field(c)); }
  std::string operator()(const IntegerListKey& k) const {
    return fmt::format("[{}]", fmt::join(k.field(c), ", "));
  }
  std::string operator()(const TextListKey& k) const {
    std::string text;
    for (const std::string& element : k.field(c)) text += (text.empty() ? "" : ", ") + quoted(element);
    return "[" + text + "]";
  }
  std::string operator()(const PoseKey& k) const { return pose_text(k.field(c)); }
  std::string operator()(const PolygonKey& k) const { return k.field(c) ? polygon_text(*k.field(c)) : "[]"; }
  std::string operator()(const PolygonListKey& k) const {
    std::string text;
    for (const types::Polygon& polygon : k.field(c))
      text += (text.empty() ? "" : ", ") + polygon_text(polygon);
    return "[" + text + "]";
  }
  std::string operator()(const SectorsKey& k) const { return sectors_text(k.field(c)); }
};

}  // namespace

std::string_view KeySpec::section() const { return std::string_view(path).substr(0, path.rfind('.')); }
std::string_view KeySpec::name() const { return std::string_view(path).substr(path.rfind('.') + 1); }

const std::vector<KeySpec>& key_table() {
  static const std::vector<KeySpec> table = make_table();
  return table;
}

std::string expected_text(const KeySpec& key) {
  const std::string text = std::visit(ExpectedText{}, key.kind);
  return key.unit.empty() ? text : fmt::format("{} ({})", text, key.unit);
}

std::string value_text(const KeySpec& key, const Configuration& configuration) {
  Configuration copy = configuration;  // fields are accessed through a mutable reference
  return std::visit(ValueText{copy}, key.kind);
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace topo::daemon
