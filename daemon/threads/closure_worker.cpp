// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/closure_worker.hpp"

#include "drivers/io/posix.hpp"

namespace topo::daemon {

void ClosureWorker::run() noexcept {
  while (!hand_overs_.stopping.load(std::memory_order_acquire)) {
    hand_overs_.closure_wakeup.wait(std::chrono::milliseconds(500));
    vitals_.beat();
    for (auto* query = hand_overs_.loop_queries.front();
         query != nullptr && !hand_overs_.stopping.load(std::memory_order_acquire);
         query = hand_overs_.loop_queries.front()) {
      answer(*query);
      hand_overs_.loop_queries.pop();
      vitals_.beat();
    }
  }
}

void ClosureWorker::answer(const slam::LoopQuery& query) {
  const types::Stamp begin = io::monotonic_now();
  slam::LoopAnswer answer = slam::find_closures(query);
  vitals_.run.record((io::monotonic_now() - begin).count());
  // A full ring means that the mapping thread stands still; the ring counts what is lost.
  if (slam::LoopAnswer* slot = hand_overs_.loop_answers.try_acquire(); slot != nullptr) {
    *slot = std::move(answer);
    hand_overs_.loop_answers.commit();
    hand_overs_.mapping_wakeup.post();
  }
}

}  // namespace topo::daemon
