// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "daemon/threads/base_worker.hpp"
#include "daemon/threads/closure_worker.hpp"
#include "daemon/threads/journal_worker.hpp"
#include "daemon/threads/mapping_worker.hpp"
#include "daemon/threads/planning_worker.hpp"
#include "daemon/threads/scan_worker.hpp"
#include "daemon/threads/thread.hpp"

namespace topo::daemon {

/// Makes the connector of a device from its channel ("base", "front", "coronal") and its configured address:
/// real, tapped, a recording's or a test's.
using ConnectorFactory = std::function<types::Result<std::unique_ptr<io::Connector>>(
    const std::string& channel, const std::string& address)>;

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
  Workers(const Configuration& configuration, HandOvers& hand_overs)
      : configuration_(configuration), hand_overs_(hand_overs) {}
  template <class Worker>
  types::Status launch(Thread& thread, const ThreadSettings& settings, Worker& worker);
  [[nodiscard]] ThreadSettings real_time(std::string name, int priority) const;

  const Configuration& configuration_;
  HandOvers& hand_overs_;
  Vitals base_vitals_{"base"}, front_vitals_{"front"}, coronal_vitals_{"coronal"}, mapping_vitals_{"mapping"},
      planning_vitals_{"planning"}, closure_vitals_{"closure"}, journal_vitals_{"journal"};
  std::vector<Vitals*> vital_, all_;
  std::unique_ptr<BaseWorker> base_;
  std::unique_ptr<ScanWorker> front_, coronal_;
  std::unique_ptr<MappingWorker> mapping_;
  std::unique_ptr<PlanningWorker> planning_;
  std::unique_ptr<ClosureWorker> closure_;
  std::unique_ptr<JournalWorker> journal_;                 ///< null: no journal is kept
  std::array<sync::Ring<FixedText<160>, 4>, 7> refusals_;  ///< one producer each
  std::size_t launched_ = 0;
  Thread journal_thread_, closure_thread_, mapping_thread_, planning_thread_, coronal_thread_, front_thread_,
      base_thread_;
};

}  // namespace topo::daemon
