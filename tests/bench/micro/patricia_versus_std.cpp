// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The same work with the standard containers, where a version is a copy; and the floor of any copy, memcpy.
#include <benchmark/benchmark.h>

#include <map>
#include <unordered_map>

#include "tests/bench/micro/fixture.hpp"

namespace topo::bench {
namespace {

struct KeyHash {
  std::size_t operator()(Key key) const {
    key *= 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(key ^ (key >> 32U));
  }
};
using Tree = std::map<Key, Bits>;
using Table = std::unordered_map<Key, Bits, KeyHash>;

template <class Container>
Container make_standard(std::int64_t n) {
  Container c;
  for (const Key key : square_keys(n)) c.emplace(key, 1);
  return c;
}

template <class Container>
void BM_StdBuildShuffled(benchmark::State& state) {
  const std::vector<Key> keys = shuffled(square_keys(state.range(0)));
  for (auto _ : state) {
    Container c;
    for (const Key key : keys) c[key] |= 1U;
    state.PauseTiming();
    { const Container gone = std::move(c); }
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(keys.size()));
}
BENCHMARK(BM_StdBuildShuffled<Tree>)->Arg(1000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_StdBuildShuffled<Table>)->Arg(1000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

template <class Container>
void BM_StdFindNear(benchmark::State& state) {
  const Container c = make_standard<Container>(state.range(0));
  const std::vector<Key> keys = room_keys(state.range(0), 1);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(c.find(keys[i]));
    if (++i == keys.size()) i = 0;
  }
}
BENCHMARK(BM_StdFindNear<Tree>)->Arg(1000)->Arg(100000)->Arg(1000000);
BENCHMARK(BM_StdFindNear<Table>)->Arg(1000)->Arg(100000)->Arg(1000000);

template <class Container>
void BM_StdFindShuffled(benchmark::State& state) {
  const Container c = make_standard<Container>(state.range(0));
  const std::vector<Key> keys = shuffled(square_keys(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(c.find(keys[i]));
    if (++i == keys.size()) i = 0;
  }
}
BENCHMARK(BM_StdFindShuffled<Tree>)->Arg(1000)->Arg(100000)->Arg(1000000);
BENCHMARK(BM_StdFindShuffled<Table>)->Arg(1000)->Arg(100000)->Arg(1000000);

/// A batch of about a thousand near keys, then a version for a reader: a copy, here.
template <class Container>
void BM_StdBatchAndCopy(benchmark::State& state) {
  Container c = make_standard<Container>(state.range(0));
  Container published = c;
  std::int64_t step = 0;
  std::int64_t keys_done = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const std::vector<Key> keys = room_keys(state.range(0), ++step);
    state.ResumeTiming();
    for (const Key key : keys) c[key] |= 1U << (step % 31);
    published = c;
    keys_done += static_cast<std::int64_t>(keys.size());
  }
  state.SetItemsProcessed(keys_done);
}
BENCHMARK(BM_StdBatchAndCopy<Tree>)->Arg(1000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_StdBatchAndCopy<Table>)->Arg(1000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMicrosecond);

/// The floor of a version by copying: keys and values alone, without structure.
void BM_MemcpyOfPacked(benchmark::State& state) {
  const auto bytes = static_cast<std::size_t>(state.range(0)) * kPackedBytes;
  const std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes, 2);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}
BENCHMARK(BM_MemcpyOfPacked)->Arg(1000)->Arg(100000)->Arg(10000000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace topo::bench
