// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"

namespace topo::daemon {

/// The loop closure thread: answers the mapping thread's queries one by one, graph queries first. A slow
/// answer is late but never blocks.
class ClosureWorker final : public Worker {
 public:
  ClosureWorker(HandOvers& hand_overs, Vitals& vitals) : hand_overs_(hand_overs), vitals_(vitals) {}

  /// The thread's body: runs until hand_overs.ending.stopping.
  void run() noexcept override;

 private:
  bool answer_one();
  void answer(const slam::GraphQuery& query);
  void answer(const slam::LoopQuery& query);
  void answer(const slam::AlignmentQuery& query);
  template <class Answer, std::size_t N>
  void hand_back(sync::Ring<Answer, N>& ring, Answer answer, types::Stamp begin);

  HandOvers& hand_overs_;
  Vitals& vitals_;
};

}  // namespace topo::daemon
