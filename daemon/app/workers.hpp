// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/sync/ring.hpp"
#include "daemon/app/connector_factory.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/threads/fixed_text.hpp"
#include "daemon/threads/thread.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"

namespace topo::daemon {

struct HandOvers;

/// The workers and their threads, from start to orderly stop.
class Workers {
 public:
  /// Creates connections and workers; accesses no device yet.
  static types::Result<std::unique_ptr<Workers>> make(const Configuration& configuration,
                                                      HandOvers& hand_overs,
                                                      const ConnectorFactory& connectors);
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() { stop(); }

  types::Status start();
  /// Ends the threads of the devices: the robot stands, the lasers are off. Bounded by the connections'
  /// closing times, independent of the other threads.
  void close_devices();
  /// As close_devices(), then ends all other threads and waits for them. Bounded by their current work: a
  /// mapping step, a search for closures or the graph's solution, a planning step, and for the journal its
  /// wait for the mapping thread (5 s) and its writes.
  void stop();

  /// Threads that must advance for the daemon to count as alive.
  [[nodiscard]] const std::vector<Vitals*>& vital() const { return vital_; }
  /// All threads.
  [[nodiscard]] const std::vector<Vitals*>& all() const { return all_; }
  /// Main only; returns every message once: settings that the system refused to a thread (real-time
  /// scheduling, CPUs).
  std::vector<std::string> take_refusals();

 private:
  /// A worker, its thread and what other threads see of it.
  struct Post {
    explicit Post(std::string_view name) : vitals(name) {}
    Vitals vitals;
    std::unique_ptr<Worker> worker;          ///< null: the configuration has none
    sync::Ring<FixedText<160>, 4> refusals;  ///< settings that the system refused to the thread
    Thread thread;
  };

  Workers(const Configuration& configuration, HandOvers& hand_overs)
      : configuration_(configuration), hand_overs_(hand_overs) {}
  [[nodiscard]] std::array<Post*, 8> posts();
  void list_vitals();
  types::Status launch(Post& post, ThreadSettings settings);
  [[nodiscard]] ThreadSettings real_time(int priority) const;

  const Configuration& configuration_;
  HandOvers& hand_overs_;
  Post base_{"base"}, front_{"front"}, coronal_{"coronal"}, mapping_{"mapping"}, planning_{"planning"},
      closure_{"closure"}, journal_{"journal"}, team_{"team"};
  std::vector<Vitals*> vital_, all_;
};

}  // namespace topo::daemon
