// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/byte_ring.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <atomic>
#include <deque>
#include <thread>

namespace topo::daemon {
namespace {

TEST(ByteRing, BehavesAsABoundedQueueOfBytes) {
  EXPECT_TRUE(rc::check([](const std::vector<std::pair<bool, std::vector<std::uint8_t>>>& steps) {
    ByteRing ring(64);
    std::deque<std::byte> model;
    for (const auto& [write, data] : steps) {
      const auto bytes = std::as_bytes(std::span(data));
      if (write) {
        const std::size_t head = bytes.size() / 3;
        const bool fits = model.size() + bytes.size() <= 64;
        RC_ASSERT(ring.try_write(bytes.first(head), bytes.subspan(head)) == fits);
        if (fits) model.insert(model.end(), bytes.begin(), bytes.end());
      } else {
        std::vector<std::byte> out(std::min(model.size(), data.size()));
        ring.peek(out);
        RC_ASSERT(std::equal(out.begin(), out.end(), model.begin()));
        ring.drop(out.size());
        model.erase(model.begin(), model.begin() + static_cast<std::ptrdiff_t>(out.size()));
      }
      RC_ASSERT(ring.size() == model.size());
    }
  }));
}

TEST(ByteRing, HandsWholeWritesToAnotherThread) {
  ByteRing ring(256);
  constexpr int kRecords = 50000;
  std::atomic<bool> stop{false};
  std::thread producer([&ring, &stop] {
    for (int i = 0; i < kRecords && !stop;) {
      const auto n = static_cast<std::uint8_t>(1 + i % 40);
      std::array<std::byte, 41> data{};
      data.fill(static_cast<std::byte>(i & 0xFF));
      data[0] = static_cast<std::byte>(n);
      if (ring.try_write(std::span(data).first(1), std::span(data).subspan(1, n))) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  int bad = 0;
  for (int i = 0; i < kRecords;) {
    if (ring.size() == 0) {
      std::this_thread::yield();
      continue;
    }
    std::array<std::byte, 41> data{};
    ring.peek(std::span(data).first(1));
    const auto n = std::to_integer<std::size_t>(data[0]);
    const std::size_t expected = 1U + static_cast<std::size_t>(i) % 40U;
    bad += n == expected && ring.size() >= n + 1 ? 0 : 1;
    if (bad > 0) break;
    ring.peek(std::span(data).first(n + 1));
    ring.drop(n + 1);
    for (std::size_t k = 1; k <= n; ++k) bad += data[k] == static_cast<std::byte>(i & 0xFF) ? 0 : 1;
    ++i;
  }
  EXPECT_EQ(bad, 0);
  stop = true;
  producer.join();
}

}  // namespace
}  // namespace topo::daemon
