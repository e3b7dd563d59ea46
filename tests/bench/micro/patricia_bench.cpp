// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What the Patricia map costs: by the key (items_per_second), by the version, and in bytes.
#include <benchmark/benchmark.h>

#include "tests/bench/micro/fixture.hpp"

namespace topo::bench {
namespace {

constexpr std::int64_t kSmall = 1024;
constexpr std::int64_t kMiddle = 100000;
constexpr std::int64_t kLarge = 10000000;

void build(benchmark::State& state, const std::vector<Key>& keys) {
  std::size_t bytes = 0;
  for (auto _ : state) {
    BitArena arena;
    BitMap map(arena);
    for (const Key key : keys) map.insert_with(key, 1, kUnion);
    bytes = arena.counts().bytes_reserved;
    state.PauseTiming();
    map.clear();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(keys.size()));
  state.counters["bytes_per_key"] = static_cast<double>(bytes) / static_cast<double>(keys.size());
}
void BM_BuildRowByRow(benchmark::State& state) { build(state, square_keys(state.range(0))); }
void BM_BuildShuffled(benchmark::State& state) { build(state, shuffled(square_keys(state.range(0)))); }
BENCHMARK(BM_BuildRowByRow)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_BuildShuffled)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMillisecond);

void find_all(benchmark::State& state, const std::vector<Key>& keys) {
  BitArena arena;
  const BitMap map = make_square(arena, state.range(0));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(map.find(keys[i]));
    if (++i == keys.size()) i = 0;
  }
}
void BM_FindNear(benchmark::State& state) { find_all(state, room_keys(state.range(0), 1)); }
void BM_FindShuffled(benchmark::State& state) { find_all(state, shuffled(square_keys(state.range(0)))); }
BENCHMARK(BM_FindNear)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge);
BENCHMARK(BM_FindShuffled)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge);

/// The mapping thread's step: a batch of a keyframe's columns, after which the new version is held and the
/// old dropped.
void BM_BatchChanging(benchmark::State& state) {
  BitArena arena;
  BitMap map = make_square(arena, state.range(0));
  BitMap published = map;
  std::int64_t step = 0;
  std::int64_t keys_done = 0;
  std::size_t copied_bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const std::vector<Key> keys = room_keys(state.range(0), ++step);
    const auto before = arena.counts();
    const Bits value = 1U << (1U + static_cast<unsigned>(step % 31));
    state.ResumeTiming();
    for (const Key key : keys) {
      map.insert_with(key, value, [](const Bits& a, const Bits& b) { return (a & 1U) | b; });
    }
    state.PauseTiming();
    const auto after = arena.counts();
    copied_bytes = (after.leaves - before.leaves) * 16 + (after.branches - before.branches) * 32;
    state.ResumeTiming();
    published = map;
    keys_done += static_cast<std::int64_t>(keys.size());
  }
  state.SetItemsProcessed(keys_done);
  state.counters["bytes_copied"] = static_cast<double>(copied_bytes);
  state.counters["memcpy_us"] = memcpy_seconds(copied_bytes) * 1e6;
}
BENCHMARK(BM_BatchChanging)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMicrosecond);

/// The same cells with nothing new in them: nothing is copied and the version stays the same.
void BM_BatchSeenBefore(benchmark::State& state) {
  BitArena arena;
  BitMap map = make_square(arena, state.range(0));
  const BitMap published = map;
  const std::vector<Key> keys = room_keys(state.range(0), 1);
  for (auto _ : state) {
    for (const Key key : keys) map.insert_with(key, 1U, kUnion);
  }
  if (!map.same_version(published)) state.SkipWithError("a batch that changes nothing copied something");
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(keys.size()));
}
BENCHMARK(BM_BatchSeenBefore)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMicrosecond);

void BM_BatchInPlace(benchmark::State& state) {
  BitArena arena;
  BitMap map = make_square(arena, state.range(0));
  const std::vector<Key> keys = room_keys(state.range(0), 1);
  for (auto _ : state) {
    for (const Key key : keys) ++map.update(key);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(keys.size()));
}
BENCHMARK(BM_BatchInPlace)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMicrosecond);

void BM_SnapshotTakeAndDrop(benchmark::State& state) {
  BitArena arena;
  const BitMap map = make_square(arena, state.range(0));
  for (auto _ : state) {
    const BitMap snapshot = map;
    benchmark::DoNotOptimize(snapshot.root());
  }
}
BENCHMARK(BM_SnapshotTakeAndDrop)->Arg(kSmall)->Arg(kLarge);

void BM_WindowFold(benchmark::State& state) {
  BitArena arena;
  const BitMap map = make_square(arena, state.range(0));
  std::int64_t seen = 0;
  std::int32_t shift = 0;
  for (auto _ : state) {
    shift = (shift + 37) % std::max(square_side(state.range(0)) - 100, 1);
    const std::int32_t low = shift - square_side(state.range(0)) / 2;
    Bits all = 0;
    map.for_each_in({{low, -50}, {low + 99, 49}}, [&](Key, Bits b) { all += b; });
    benchmark::DoNotOptimize(all);
    seen += static_cast<std::int64_t>(all);
  }
  state.SetItemsProcessed(seen);
}
BENCHMARK(BM_WindowFold)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMicrosecond);

void BM_FoldAll(benchmark::State& state) {
  BitArena arena;
  const BitMap map = make_square(arena, state.range(0));
  for (auto _ : state) {
    Bits all = 0;
    map.for_each([&](Key, Bits b) { all += b; });
    benchmark::DoNotOptimize(all);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_FoldAll)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMillisecond);

void BM_DifferenceAfterBatch(benchmark::State& state) {
  BitArena arena;
  const BitMap before = make_square(arena, state.range(0));
  BitMap after = before;
  for (const Key key : room_keys(state.range(0), 1)) after.insert(key, 2);
  std::int64_t reported = 0;
  for (auto _ : state) {
    BitMap::difference(before, after, [&](Key, const Bits*, const Bits*) { ++reported; });
  }
  state.SetItemsProcessed(reported);
}
BENCHMARK(BM_DifferenceAfterBatch)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMicrosecond);

/// Two maps of n keys built apart, half of whose keys meet.
void BM_UnionOfStrangers(benchmark::State& state) {
  BitArena arena;
  const BitMap a = make_square(arena, state.range(0));
  BitMap b(arena);
  for (const Key key : square_keys(state.range(0))) {
    const Cell c = patricia::cell_of(key);
    b.insert(cell_key(c.x + square_side(state.range(0)) / 2, c.y), 2);
  }
  for (auto _ : state) {
    const BitMap both = BitMap::merge(a, b, kUnion);
    benchmark::DoNotOptimize(both.root());
  }
  state.SetItemsProcessed(state.iterations() * 2 * state.range(0));
}
BENCHMARK(BM_UnionOfStrangers)->Arg(kSmall)->Arg(kMiddle)->Arg(1000000)->Unit(benchmark::kMillisecond);

/// Two versions of one map, each with a batch of its own.
void BM_UnionOfVersions(benchmark::State& state) {
  BitArena arena;
  BitMap a = make_square(arena, state.range(0));
  BitMap b = a;
  for (const Key key : room_keys(state.range(0), 1)) a.insert(key, 2);
  for (const Key key : room_keys(state.range(0), 2)) b.insert(key, 4);
  for (auto _ : state) {
    const BitMap both = BitMap::merge(a, b, kUnion, patricia::SharedSubtrees::kKeep);
    benchmark::DoNotOptimize(both.root());
  }
}
BENCHMARK(BM_UnionOfVersions)->Arg(kSmall)->Arg(kMiddle)->Arg(kLarge)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace topo::bench
