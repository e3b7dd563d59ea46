// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/workers.hpp"

#include "daemon/app/session_control.hpp"
#include "daemon/session/origin.hpp"

namespace topo::daemon {
namespace {

using types::Result;
using types::Status;

hokuyo::ConnectionConfig session_config(const std::string& name, const ScannerConfig& scanner) {
  hokuyo::ConnectionConfig config;
  config.name = name;
  config.serial_number = scanner.serial_number;
  config.intensity = scanner.intensity;
  config.skip_scans = scanner.skip_scans;
  config.stamp_offset_s = scanner.stamp_offset_s;
  return config;
}

pioneer::ConnectionConfig session_config(const Configuration& configuration) {
  const BaseConfig& base = configuration.base;
  pioneer::ConnectionConfig config;
  config.expected_subclass = configuration.robot.model == RobotModel::kP3at ? "p3at-sh" : "p3dx-sh";
  config.take_limits(base);
  config.sonar = base.sonar;
  return config;
}

}  // namespace

Result<std::unique_ptr<Workers>> Workers::make(const Configuration& c, HandOvers& hand_overs,
                                               const ConnectorFactory& connectors) {
  std::unique_ptr<Workers> workers(new Workers(c, hand_overs));
  auto base = connectors("base", c.base.address);
  if (!base) return tl::unexpected(base.error());
  workers->base_ = std::make_unique<BaseWorker>(
      hand_overs, control_setup(c),
      std::make_unique<pioneer::Connection>(session_config(c), std::move(*base)), workers->base_vitals_);
  auto front = connectors("front", c.front.address);
  if (!front) return tl::unexpected(front.error());
  workers->front_ = std::make_unique<ScanWorker>(
      hand_overs, hand_overs.front, true,
      std::make_unique<hokuyo::Connection>(session_config("front", c.front), std::move(*front)),
      workers->front_vitals_);
  workers->vital_ = {&workers->base_vitals_, &workers->front_vitals_};
  if (c.coronal.present) {
    auto coronal = connectors("coronal", c.coronal.address);
    if (!coronal) return tl::unexpected(coronal.error());
    workers->coronal_ = std::make_unique<ScanWorker>(
        hand_overs, hand_overs.coronal, false,
        std::make_unique<hokuyo::Connection>(session_config("coronal", c.coronal), std::move(*coronal)),
        workers->coronal_vitals_);
    workers->vital_.push_back(&workers->coronal_vitals_);
  }
  workers->mapping_ = std::make_unique<MappingWorker>(hand_overs, mapper_params(c), new_maker(c.robot.id),
                                                      workers->mapping_vitals_);
  workers->planning_ = std::make_unique<PlanningWorker>(hand_overs, planner_params(c),
                                                        types::from_seconds(c.exploration.planning_period_s),
                                                        workers->planning_vitals_);
  workers->closure_ = std::make_unique<ClosureWorker>(hand_overs, workers->closure_vitals_);
  if (!c.session.folder.empty() && c.session.journal) {
    const JournalSettings settings{c.session.folder, types::from_seconds(c.session.journal_period_s),
                                   static_cast<std::size_t>(c.session.keep), params_hash(c)};
    workers->journal_ = std::make_unique<JournalWorker>(hand_overs, settings, workers->journal_vitals_);
  }
  workers->vital_.push_back(&workers->mapping_vitals_);
  workers->vital_.push_back(&workers->planning_vitals_);
  workers->all_ = workers->vital_;
  workers->all_.push_back(&workers->closure_vitals_);
  if (workers->journal_ != nullptr) workers->all_.push_back(&workers->journal_vitals_);
  return workers;
}

ThreadSettings Workers::real_time(std::string name, int priority) const {
  const RealtimeConfig& config = configuration_.realtime;
  ThreadSettings settings;
  settings.name = std::move(name);
  settings.fifo_priority = config.policy == RealtimePolicy::kOff ? 0 : priority;
  settings.cpus = config.cpus;
  return settings;
}

template <class Worker>
Status Workers::launch(Thread& thread, const ThreadSettings& settings, Worker& worker) {
  auto& refusals = refusals_.at(launched_++);
  return thread.start(settings, [settings, &worker, &refusals] {
    for (const std::string& refusal : apply_settings(settings)) {
      if (auto* slot = refusals.try_acquire(); slot != nullptr) {
        *slot = refusal;
        refusals.commit();
      }
    }
    worker.run();
  });
}

Status Workers::start() {
  const RealtimeConfig& config = configuration_.realtime;
  ThreadSettings closure, mapping, planning, journal;
  closure.name = "closure";
  journal.name = "journal";
  closure.nice = journal.nice = 5;
  mapping.name = "mapping";
  planning.name = "planning";
  closure.stack_bytes = mapping.stack_bytes = planning.stack_bytes = 8 << 20;
  if (auto s = launch(closure_thread_, closure, *closure_); !s) return s;
  if (auto s = launch(mapping_thread_, mapping, *mapping_); !s) return s;
  if (auto s = launch(planning_thread_, planning, *planning_); !s) return s;
  if (journal_ != nullptr) {
    if (auto s = launch(journal_thread_, journal, *journal_); !s) return s;
  }
  if (coronal_ != nullptr) {
    if (auto s = launch(coronal_thread_, real_time("coronal", config.scan_priority), *coronal_); !s) return s;
  }
  if (auto s = launch(front_thread_, real_time("front", config.scan_priority), *front_); !s) return s;
  return launch(base_thread_, real_time("base", config.base_priority), *base_);
}

void Workers::close_devices() {
  hand_overs_.devices_closing.store(true, std::memory_order_release);
  base_thread_.join();
  front_thread_.join();
  coronal_thread_.join();
}

void Workers::stop() {
  close_devices();
  hand_overs_.stopping.store(true, std::memory_order_release);
  hand_overs_.planning_wakeup.post();
  hand_overs_.closure_wakeup.post();
  hand_overs_.journal_wakeup.post();
  closure_thread_.join();
  planning_thread_.join();
  journal_thread_.join();  // the mapping thread answers it to the end
  hand_overs_.readers_gone.store(true, std::memory_order_release);
  hand_overs_.mapping_wakeup.post();
  mapping_thread_.join();
}

std::vector<std::string> Workers::take_refusals() {
  std::vector<std::string> texts;
  for (auto& ring : refusals_) {
    for (const auto* text = ring.front(); text != nullptr; text = ring.front()) {
      texts.push_back(text->str());
      ring.pop();
    }
  }
  return texts;
}

}  // namespace topo::daemon
