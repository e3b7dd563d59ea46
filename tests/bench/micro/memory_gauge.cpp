// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/micro/memory_gauge.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace topo::bench {
namespace {

std::atomic<std::size_t> live{0}, peak{0};

void* taken(std::size_t size) {
  void* const p = std::malloc(size);
  if (p == nullptr) throw std::bad_alloc();
  live += malloc_usable_size(p);
  peak = std::max(peak.load(), live.load());
  return p;
}
void give_back(void* p) {
  if (p == nullptr) return;
  live -= malloc_usable_size(p);
  std::free(p);
}

}  // namespace

std::size_t live_bytes() { return live; }
std::size_t peak_bytes() { return peak; }
void reset_peak() { peak = live.load(); }

}  // namespace topo::bench

void* operator new(std::size_t size) { return topo::bench::taken(size); }
void operator delete(void* p) noexcept { topo::bench::give_back(p); }
void operator delete(void* p, std::size_t) noexcept { topo::bench::give_back(p); }
