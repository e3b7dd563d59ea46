// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Nothing is allocated while streaming: every allocation of this program is counted.
#include "tests/unit/drivers/hokuyo/connection_fixture.hpp"
#include "tests/unit/drivers/hokuyo/scip_text.hpp"
#include "tests/unit/support/allocation_counter.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using namespace testing_scip;

class SessionAllocation : public SessionTest {};

TEST_F(SessionAllocation, StreamingAllocatesNothing) {
  start(utm_ew());
  ASSERT_TRUE(run_scans(50, 5s));
  // The sensor's next scans are queued beforehand: making them allocates, reading them does not.
  std::vector<std::uint32_t> values(1081, 2500);
  line.on_wait = nullptr;
  for (std::uint32_t k = 1; k <= 400; ++k) {
    std::string text = scan_text("MD0000108001000", 10000 + 25 * k, ranges(values));
    if (k % 50 == 25) text[200] = static_cast<char>(text[200] ^ 1);  // a dropped scan costs nothing either
    line.send_at(line.now + k * 25ms, text);
  }
  line.max_read = 1460;
  const std::uint64_t before = test::allocations();
  int got = 0;
  for (int i = 0; i < 2000 && got < 392; ++i)
    got += connection->step(scan, 10ms) == StepOutcome::kScan ? 1 : 0;
  const std::uint64_t after = test::allocations();
  EXPECT_EQ(got, 392);
  EXPECT_EQ(after - before, 0U);
  EXPECT_EQ(connection->counters().checksum_errors, 8U);
}

}  // namespace
}  // namespace topo::hokuyo
