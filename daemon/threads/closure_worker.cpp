// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/closure_worker.hpp"

#include <utility>

#include "core/slam/team_alignment.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

void ClosureWorker::run() noexcept {
  while (!hand_overs_.ending.stopping.load(std::memory_order_acquire)) {
    hand_overs_.closure.wakeup.wait(std::chrono::milliseconds(500));
    vitals_.beat();
    while (!hand_overs_.ending.stopping.load(std::memory_order_acquire) && answer_one()) vitals_.beat();
  }
}

/// False when no query waits.
bool ClosureWorker::answer_one() {
  if (const auto* query = hand_overs_.closure.graph_queries.front(); query != nullptr) {
    answer(*query);
    hand_overs_.closure.graph_queries.pop();
    return true;
  }
  if (const auto* query = hand_overs_.closure.loop_queries.front(); query != nullptr) {
    answer(*query);
    hand_overs_.closure.loop_queries.pop();
    return true;
  }
  if (const auto* query = hand_overs_.closure.alignment_queries.front(); query != nullptr) {
    answer(*query);
    hand_overs_.closure.alignment_queries.pop();
    return true;
  }
  return false;
}

void ClosureWorker::answer(const slam::AlignmentQuery& query) {
  const types::Stamp begin = io::monotonic_now();
  hand_back(hand_overs_.closure.alignments, slam::align_maps(query), begin);
}

void ClosureWorker::answer(const slam::GraphQuery& query) {
  const types::Stamp begin = io::monotonic_now();
  hand_back(hand_overs_.closure.graph_solutions, slam::solve_graph(query), begin);
}

void ClosureWorker::answer(const slam::LoopQuery& query) {
  const types::Stamp begin = io::monotonic_now();
  hand_back(hand_overs_.closure.loop_answers, slam::find_closures(query), begin);
}

template <class Answer, std::size_t N>
void ClosureWorker::hand_back(sync::Ring<Answer, N>& ring, Answer answer, types::Stamp begin) {
  vitals_.run.record((io::monotonic_now() - begin).count());
  // A full ring means that the mapping thread is blocked; the ring counts lost answers.
  if (Answer* slot = ring.try_acquire(); slot != nullptr) {
    *slot = std::move(answer);
    ring.commit();
    hand_overs_.mapping.wakeup.post();
  }
}

}  // namespace topo::daemon
