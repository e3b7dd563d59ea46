// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What one call of each hand-over costs without contention, and a scan's way through the ring.
#include <benchmark/benchmark.h>

#include <memory>

#include "core/sync/event_ring.hpp"
#include "core/sync/histogram.hpp"
#include "core/sync/latest.hpp"
#include "core/sync/ring.hpp"
#include "core/sync/snapshot_cell.hpp"
#include "core/types/scan.hpp"

namespace topo::sync {
namespace {

void BM_RingScanInPlace(benchmark::State& state) {
  auto ring = std::make_unique<Ring<types::Scan, 8>>();
  for (auto _ : state) {
    types::Scan* slot = ring->try_acquire();
    slot->beams = 1081;
    ring->commit();
    benchmark::DoNotOptimize(ring->front());
    ring->pop();
  }
}
BENCHMARK(BM_RingScanInPlace);

void BM_LatestStoreAndRead(benchmark::State& state) {
  Latest<std::uint64_t> latest;
  std::uint64_t i = 0;
  for (auto _ : state) {
    latest.store(++i);
    benchmark::DoNotOptimize(latest.read());
  }
}
BENCHMARK(BM_LatestStoreAndRead);

void BM_SnapshotPin(benchmark::State& state) {
  SnapshotCell<int, 4> cell;
  cell.publish(std::make_unique<int>(1));
  auto reader = cell.reader(0);
  for (auto _ : state) {
    const auto pin = reader.pin();
    benchmark::DoNotOptimize(pin.get());
  }
}
BENCHMARK(BM_SnapshotPin);

void BM_SnapshotPublish(benchmark::State& state) {
  SnapshotCell<int, 4> cell;
  for (auto _ : state) cell.publish(std::make_unique<int>(1));
}
BENCHMARK(BM_SnapshotPublish);

void BM_HistogramRecord(benchmark::State& state) {
  Histogram histogram;
  std::int64_t i = 0;
  for (auto _ : state) histogram.record(i += 977);
}
BENCHMARK(BM_HistogramRecord);

void BM_EventPostAndTake(benchmark::State& state) {
  auto events = std::make_unique<EventRing<64>>();
  for (auto _ : state) {
    events->post(1, 2, Severity::kInfo, {1, 2, 3}, "laser_front");
    benchmark::DoNotOptimize(events->front());
    events->pop();
  }
}
BENCHMARK(BM_EventPostAndTake);

}  // namespace
}  // namespace topo::sync
