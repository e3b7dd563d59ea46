// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.hpp"

#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <thread>

namespace topo::canary {

int read_past_heap_block(std::size_t size) {
  const auto block = std::make_unique<int[]>(size);
  const volatile int* begin = block.get();
  return begin[size];
}

int overflow_int(int step) {
  volatile int top = std::numeric_limits<int>::max();
  return top + step;
}

void lose_memory() {
  // Often, because one pointer may survive in a register and hide its block.
  for (int i = 0; i < 100; ++i) {
    volatile int* lost = new int[100];
    lost[0] = i;
  }
}

int race_on_counter() {
  int counter = 0;
  const auto count = [&counter] {
    for (int i = 0; i < 10000; ++i) {
      ++counter;
    }
  };
  std::thread first(count);
  std::thread second(count);
  first.join();
  second.join();
  return counter;
}

int index_at_size(const std::vector<int>& values) { return values[values.size()]; }

int sum(const std::vector<int>& values) { return std::accumulate(values.begin(), values.end(), 0); }

void parse(const unsigned char* data, std::size_t size) {
  if (size < 4 || std::memcmp(data, "SCIP", 4) != 0) return;
  const auto line = std::make_unique<unsigned char[]>(4);
  std::memcpy(line.get(), data, size);
  volatile unsigned char sink = line[0];
  static_cast<void>(sink);
}

}  // namespace topo::canary
