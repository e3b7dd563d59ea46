// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A producer of scans and a consumer at full speed: what arrives is whole, in order, and what is lost is
// counted.
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "core/sync/event_ring.hpp"
#include "core/sync/ring.hpp"
#include "core/types/scan.hpp"
#include "tests/stress/yielding.hpp"

namespace topo::sync {
namespace {

using types::Scan;

void fill(Scan& scan, std::uint64_t sequence) {
  scan.sequence = sequence;
  scan.beams = static_cast<std::uint16_t>(1 + sequence % Scan::kMaxBeams);
  for (std::size_t i = 0; i < scan.beams; ++i) scan.range_m[i] = static_cast<float>(sequence % 1000 + i);
}

bool whole(const Scan& scan) {
  if (scan.beams != 1 + scan.sequence % Scan::kMaxBeams) return false;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    if (scan.range_m[i] != static_cast<float>(scan.sequence % 1000 + i)) return false;
  }
  return true;
}

struct Taken {
  std::uint64_t scans = 0;
  std::uint64_t torn = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t last = 0;
  void take(const Scan& scan) {
    ++scans;
    if (!whole(scan)) ++torn;
    if (scan.sequence <= last) ++out_of_order;
    last = scan.sequence;
  }
};

template <class Steps>
void check_scans(std::uint64_t scans) {
  auto ring = std::make_unique<Ring<Scan, 8, Steps>>();
  Taken taken;
  std::thread consumer([&] {
    while (taken.last != scans) {
      if (taken.scans % 64 == 63) ring->skip_to_newest();
      const Scan* scan = ring->front();
      if (scan == nullptr) {
        std::this_thread::yield();
        continue;
      }
      taken.take(*scan);
      ring->pop();
    }
  });
  for (std::uint64_t sequence = 1; sequence <= scans; ++sequence) {
    Scan* slot = ring->try_acquire();
    while (slot == nullptr && sequence == scans) slot = ring->try_acquire();  // the last one must arrive
    if (slot == nullptr) continue;
    fill(*slot, sequence);
    ring->commit();
  }
  consumer.join();
  EXPECT_EQ(taken.torn, 0U);
  EXPECT_EQ(taken.out_of_order, 0U);
  EXPECT_EQ(taken.scans + ring->skipped(), ring->committed());
  EXPECT_GE(ring->committed() + ring->rejected(), scans);
  EXPECT_EQ(ring->size(), 0U);
}

TEST(RingStress, ScansArriveWholeAndInOrderAndLossIsCounted) { check_scans<Undisturbed>(20000); }
TEST(RingStressYielding, ScansArriveWholeAndInOrderAndLossIsCounted) { check_scans<stress::Yielding>(5000); }

template <std::size_t N, class Steps>
void check_events(std::int64_t wanted) {
  auto events = std::make_unique<EventRing<N, Steps>>();
  std::int64_t next = 0;
  std::int64_t wrong = 0;
  std::thread consumer([&] {
    while (next < wanted) {
      const std::size_t got = events->drain([&](const Event& e) {
        if (e.stamp_ns != next || e.args[2] != -next || e.text_view() != "lost packet") ++wrong;
        ++next;
      });
      if (got == 0) std::this_thread::yield();
    }
  });
  std::uint64_t refused = 0;
  for (std::int64_t i = 0; i < wanted;) {
    if (events->post(i, 3, Severity::kInfo, {0, i, -i}, "lost packet")) {
      ++i;
    } else {
      ++refused;
      std::this_thread::yield();
    }
  }
  consumer.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(next, wanted);
  EXPECT_EQ(events->lost(), refused);
}

TEST(RingStress, NothingAcceptedIsLostWithoutSkipping) { check_events<64, Undisturbed>(200000); }
TEST(RingStressYielding, NothingAcceptedIsLostWithoutSkipping) { check_events<4, stress::Yielding>(20000); }

}  // namespace
}  // namespace topo::sync
