// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Base, front scanner, clock and gate together: hostile bytes and times between the simulated devices and the
// true drivers, and an oracle that knows the truth (drive/oracle.hpp): never a motion on data that are stale
// or contradict each other, never into something, never a byte to a base that does not obey.
//
// The input is a list of acts of four bytes: kind, how many periods it lasts, and two values; "raw" is
// followed by as many bytes as it says. A fault ends with its act.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string_view>

#include "tests/fuzz/drive/host.hpp"
#include "tests/fuzz/drive/oracle.hpp"
#include "tests/fuzz/drive/world.hpp"
#include "tests/sim/devices/arcos_packet.hpp"

namespace {

using namespace topo;
using std::chrono::milliseconds;

constexpr types::Stamp kBegin{std::chrono::seconds(1000)};
constexpr int kPeriodsMax = 400, kReadyMax = 200;

enum class Kind : std::uint8_t {
  kHonest,
  kWish,
  kScanDelay,
  kScanDamage,
  kScanHeld,
  kScanSwallowed,
  kScanReplay,
  kScanRaw,
  kFrozen,
  kBlind,
  kCovered,
  kStatusDelay,
  kStatusDamage,
  kStatusHeld,
  kStatusSwallowed,
  kStatusReplay,
  kStatusRaw,
  kStatusPayload,
  kCommandsLate,
  kCommandsLost,
  kDeaf,
  kSleep,
  kBox,
  kPress,
  kClear,
  kResetBase,
  kRestartScanner,
  kUnplugBase,
  kUnplugScanner,
  kCount
};

struct Act {
  Kind kind = Kind::kHonest;
  int periods = 0;
  unsigned a = 0, b = 0;
  std::string_view raw;
};

/// A damage of bytes: rates that leave some messages whole.
void damage(fuzz::LineFaults& faults, const Act& act) {
  faults.drop_permille = act.a % 50;
  faults.flip_permille = act.b % 50;
}

void delay(fuzz::HostileLine& line, const Act& act) {
  line.faults.delay = milliseconds(act.a * 8);
  line.faults.delay_growth = milliseconds(act.b % 32);
  line.begin_delay();
}

class Run {
 public:
  Run() : world_(kBegin), host_(world_) {}

  /// False when the devices do not come up or the robot does not drive: then nothing would be tested.
  bool begin() {
    for (int i = 0; i < kReadyMax && !host_.ready(); ++i) host_.period();
    host_.wish = {0.5, 0.0};
    periods(20);
    constexpr double kDrives_mps = 0.2;
    return host_.ready() && world_.v_mps() > kDrives_mps;
  }

  void act(const Act& act) {
    apply(act);
    periods(act.periods);
    end(act);
  }
  [[nodiscard]] bool over() const { return left_ <= 0; }

 private:
  void periods(int count) {
    for (int i = 0; i < count && left_ > 0; ++i, --left_) {
      host_.period();
      check();
    }
  }
  void check() {
    const std::string found = oracle_.judge(world_, host_);
    if (found.empty()) return;
    std::fprintf(stderr, "oracle: after %.2f s: %s\n", types::to_seconds(host_.now() - kBegin),
                 found.c_str());
    std::abort();
  }
  void apply(const Act& act);
  void apply_to_base(const Act& act);
  void end(const Act& act);

  fuzz::World world_;
  fuzz::Host host_;
  fuzz::Oracle oracle_;
  int left_ = kPeriodsMax;
};

void Run::apply(const Act& act) {
  fuzz::HostileLine& scans = world_.scan_line;
  switch (act.kind) {
    case Kind::kWish:
      host_.wish = {std::min(act.a, 160U) * 0.005, (static_cast<int>(act.b) - 128) * 0.004};
      return;
    case Kind::kScanDelay:
      return delay(scans, act);
    case Kind::kScanDamage:
      return damage(scans.faults, act);
    case Kind::kScanHeld:
      scans.faults.holds = true;
      return;
    case Kind::kScanSwallowed:
      scans.faults.swallows = true;
      return;
    case Kind::kScanReplay:
      return scans.replay(host_.now());
    case Kind::kScanRaw:
      return scans.inject(act.raw, host_.now());
    case Kind::kFrozen:
      world_.lies.frozen = true;
      return;
    case Kind::kBlind:
      world_.lies.blind = true;
      return;
    case Kind::kCovered:
      world_.lies.covered = true;
      return;
    case Kind::kSleep:
      host_.sleep(milliseconds(act.a * 16));
      return check();
    case Kind::kBox:
      return world_.add_box(act.a * 0.01);
    case Kind::kPress:
      host_.estop = true;
      return;
    case Kind::kClear:
      host_.estop = false;
      host_.estop_cleared = true;
      return;
    case Kind::kRestartScanner:
      return world_.restart_scanner();
    case Kind::kUnplugScanner:
      host_.unplug_scanner(true);
      return;
    default:
      return apply_to_base(act);
  }
}

void Run::apply_to_base(const Act& act) {
  fuzz::HostileLine& statuses = world_.base_line;
  switch (act.kind) {
    case Kind::kStatusDelay:
      return delay(statuses, act);
    case Kind::kStatusDamage:
      return damage(statuses.faults, act);
    case Kind::kStatusHeld:
      statuses.faults.holds = true;
      return;
    case Kind::kStatusSwallowed:
      statuses.faults.swallows = true;
      return;
    case Kind::kStatusReplay:
      return statuses.replay(host_.now());
    case Kind::kStatusRaw:
      return statuses.inject(act.raw, host_.now());
    case Kind::kStatusPayload: {
      sim::arcos::PacketBuilder packet(static_cast<std::uint8_t>(act.a));
      for (const char c : act.raw.substr(0, 200)) packet.u8(c);
      return statuses.inject(packet.frame(), host_.now());
    }
    case Kind::kCommandsLate:
      world_.command_faults.delay = milliseconds(act.a * 8);
      return;
    case Kind::kCommandsLost:
      world_.command_faults.lost = true;
      return;
    case Kind::kDeaf:
      world_.lies.deaf = true;
      return;
    case Kind::kResetBase:
      return world_.reset_base();
    case Kind::kUnplugBase:
      host_.unplug_base(true);
      return;
    default:
      return;
  }
}

/// What a replug or the end of a fault leaves in the lines arrives.
void Run::end(const Act& act) {
  for (fuzz::HostileLine* line : {&world_.scan_line, &world_.base_line}) {
    line->faults = {};
    line->begin_delay();
  }
  world_.lies = {};
  world_.command_faults = {};
  if (act.kind == Kind::kUnplugBase) world_.base_line.clear();
  if (act.kind == Kind::kUnplugScanner) world_.scan_line.clear();
  host_.unplug_base(false);
  host_.unplug_scanner(false);
}

Act next_act(std::span<const std::uint8_t>& rest) {
  Act act{static_cast<Kind>(rest[0] % static_cast<unsigned>(Kind::kCount)), rest[1], rest[2], rest[3], {}};
  rest = rest.subspan(4);
  const bool has_raw =
      act.kind == Kind::kScanRaw || act.kind == Kind::kStatusRaw || act.kind == Kind::kStatusPayload;
  if (!has_raw) return act;
  const std::size_t size = std::min<std::size_t>(act.b, rest.size());
  act.raw = {reinterpret_cast<const char*>(rest.data()), size};
  rest = rest.subspan(size);
  return act;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto run = std::make_unique<Run>();
  if (!run->begin()) {
    std::fprintf(stderr, "oracle: without a fault the robot does not drive\n");
    std::abort();
  }
  std::span<const std::uint8_t> rest(data, size);
  while (rest.size() >= 4 && !run->over()) run->act(next_act(rest));
  return 0;
}
