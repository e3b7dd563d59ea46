// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The use of it all: a scanner's session over a recording gives the scans that the session gave when it was
// recorded.
#include <gmock/gmock.h>

#include <cstring>
#include <vector>

#include "daemon/recording/replay.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/io/tap.hpp"
#include "tests/unit/daemon/recording/recording_samples.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"
#include "tests/unit/drivers/hokuyo/fake_sensor.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using testing::HandMade;
using types::Stamp;

struct Seen {
  Stamp first_beam;
  std::vector<float> ranges;
};

Seen seen(const types::Scan& scan) { return {scan.first_beam, {scan.ranges().begin(), scan.ranges().end()}}; }

/// Records on the clock of the line, which the Recorder's own start would not fit.
class HandTap final : public io::ByteTap {
 public:
  HandTap(HandMade& made, Stamp start) : made_(made), start_(start) {}
  void on_open(Stamp stamp) noexcept override { add(RecordKind::kOpen, stamp, {}); }
  void on_close(Stamp stamp) noexcept override { add(RecordKind::kClose, stamp, {}); }
  void on_bytes(io::Direction direction, Stamp stamp, std::span<const std::byte> bytes) noexcept override {
    add(direction == io::Direction::kFromDevice ? RecordKind::kFromDevice : RecordKind::kToDevice, stamp,
        bytes);
  }

 private:
  void add(RecordKind kind, Stamp stamp, std::span<const std::byte> bytes) {
    made_.add_at(0, kind, stamp - start_, testing::text_of(bytes));
  }
  HandMade& made_;
  Stamp start_;
};

std::vector<Seen> record(const std::string& path, int scans) {
  mocks::ScriptedLine line;
  hokuyo::testing_scip::FakeSensor sensor(line, hokuyo::testing_scip::kSamples[3]);
  HandMade made(path, {"front"});
  std::vector<Seen> all;
  {
    HandTap tap(made, line.now);
    hokuyo::Connection session(
        {.name = "front"},
        std::make_unique<io::TappedConnector>(std::make_unique<mocks::ScriptedConnector>(line), &tap));
    types::Scan scan;
    const Stamp limit = line.now + 60s;
    while (static_cast<int>(all.size()) < scans && line.now < limit) {
      if (session.step(scan, 10ms) == hokuyo::StepOutcome::kScan) all.push_back(seen(scan));
    }
  }
  EXPECT_TRUE(made.frame());
  return all;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(SessionReplay, GivesTheScansOfTheRecordingAtTheirDistances) {
  const testing::TempDir dir;
  const std::vector<Seen> recorded = record(dir.file("a.rec"), 12);
  ASSERT_EQ(recorded.size(), 12U);
  auto replay = Replay::open(dir.file("a.rec"));
  ASSERT_TRUE(replay.has_value()) << replay.error().message;
  auto connector = Replay::connector(*replay, "front", false);
  ASSERT_TRUE(connector.has_value());
  hokuyo::Connection session({.name = "front"}, std::move(*connector));
  std::vector<Seen> replayed;
  types::Scan scan;
  const Stamp limit = io::monotonic_now() + 30s;
  while (!(*replay)->finished() && io::monotonic_now() < limit) {
    if (session.step(scan, 10ms) == hokuyo::StepOutcome::kScan) replayed.push_back(seen(scan));
  }
  EXPECT_TRUE((*replay)->finished()) << session.message();
  EXPECT_EQ((*replay)->gates_released(), 0);
  ASSERT_EQ(replayed.size(), recorded.size()) << session.message();
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    EXPECT_TRUE(same_bits(recorded[i].ranges, replayed[i].ranges)) << "scan " << i;
    const auto then = recorded[i].first_beam - recorded[0].first_beam,
               now = replayed[i].first_beam - replayed[0].first_beam;
    EXPECT_LT(std::chrono::abs(now - then), 20ms) << "scan " << i;
  }
}

}  // namespace
}  // namespace topo::daemon
