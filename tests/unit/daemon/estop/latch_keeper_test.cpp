// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/latch_keeper.hpp"

#include <gtest/gtest.h>

#include <semaphore>
#include <vector>

#include "drivers/io/posix.hpp"

#include <poll.h>

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

/// A store whose disk takes as long as the test wants.
struct Disk {
  std::counting_semaphore<100> begun{0}, may_end{0};
  std::vector<std::string> acts;  ///< written by the keeper's thread, read after it has ended or reported
  bool full = false;

  LatchStore store() {
    const auto act = [this](const std::string& what) -> types::Status {
      begun.release();
      may_end.acquire();
      acts.push_back(what);
      if (full) return types::fail(types::Errc::kIo, "no space left");
      return {};
    };
    return {[act](const std::string& reason) { return act("keep " + reason); },
            [act] { return act("forget"); }};
  }
};

LatchKeeper::Done wait_for_news(LatchKeeper& keeper) {
  for (int tries = 0; tries < 100; ++tries) {
    EXPECT_GT(io::wait_for(keeper.fd(), POLLIN, 10s), 0);
    if (auto done = keeper.take_done()) return *done;
  }
  ADD_FAILURE() << "no news";
  return {};
}

TEST(LatchKeeper, WishesDoNotWaitForTheDisk) {
  Disk disk;
  LatchKeeper keeper(disk.store());
  ASSERT_TRUE(keeper.start());
  const auto first = keeper.keep("a");
  disk.begun.acquire();  // the disk works, and does not end
  const auto second = keeper.forget();
  const auto third = keeper.keep("b");
  EXPECT_LT(first, second);
  EXPECT_FALSE(keeper.take_done());
  disk.may_end.release(100);
  auto done = wait_for_news(keeper);
  while (done.wish != third) done = wait_for_news(keeper);
  EXPECT_TRUE(done.outcome);
  keeper.stop();
  EXPECT_EQ(disk.acts, (std::vector<std::string>{"keep a", "keep b"})) << "only the newest wish counts";
}

TEST(LatchKeeper, FailureIsToldAndTriedAgain) {
  Disk disk;
  disk.full = true;
  LatchKeeper keeper(disk.store());
  ASSERT_TRUE(keeper.start());
  const auto wish = keeper.keep("a");
  disk.may_end.release(1);
  EXPECT_FALSE(wait_for_news(keeper).outcome);
  disk.begun.acquire();
  disk.begun.acquire();  // the second attempt
  disk.full = false;
  disk.may_end.release(10);
  const auto done = wait_for_news(keeper);
  EXPECT_TRUE(done.outcome);
  EXPECT_EQ(done.wish, wish);
}

TEST(LatchKeeper, TheLastWishIsCarriedOutBeforeTheEnd) {
  Disk disk;
  LatchKeeper keeper(disk.store());
  ASSERT_TRUE(keeper.start());
  keeper.forget();
  disk.begun.acquire();
  keeper.keep("a");
  disk.may_end.release(10);
  keeper.stop();
  EXPECT_EQ(disk.acts, (std::vector<std::string>{"forget", "keep a"}));
}

}  // namespace
}  // namespace topo::daemon
