// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/workers.hpp"

#include "daemon/app/connection_configs.hpp"
#include "daemon/app/session_control.hpp"
#include "daemon/estop/latch_file.hpp"
#include "daemon/session/origin.hpp"
#include "daemon/threads/base_worker.hpp"
#include "daemon/threads/closure_worker.hpp"
#include "daemon/threads/journal_worker.hpp"
#include "daemon/threads/mapping_worker.hpp"
#include "daemon/threads/planning_worker.hpp"
#include "daemon/threads/scan_worker.hpp"
#include "daemon/threads/team_worker.hpp"

namespace topo::daemon {
namespace {

using types::Result;
using types::Status;

TeamSettings team_settings(const Configuration& c) {
  TeamSettings settings;
  settings.name = c.team.name;
  settings.robot = static_cast<std::uint16_t>(c.robot.id);
  settings.in_common_frame = c.team.start.has_value();
  settings.socket = c.team.socket;
  settings.awaits_journal = !c.session.folder.empty() && !c.session.resume.empty();
  settings.exchange.rates.unicast = !c.team.peers.empty();
  return settings;
}

/// With what the daemon before left behind.
pipeline::ControlSetup setup_at_start(const Configuration& configuration) {
  pipeline::ControlSetup setup = control_setup(configuration);
  const std::string& folder = configuration.control.state_folder;
  setup.disobeyed = !folder.empty() && read_latch(silence_path(folder)).latched;
  return setup;
}

}  // namespace

Result<std::unique_ptr<Workers>> Workers::make(const Configuration& c, HandOvers& hand_overs,
                                               const ConnectorFactory& connectors) {
  std::unique_ptr<Workers> made(new Workers(c, hand_overs));
  Workers& w = *made;
  auto base = connectors("base", c.base.address);
  if (!base) return tl::unexpected(base.error());
  w.base_.worker = std::make_unique<BaseWorker>(
      hand_overs, setup_at_start(c), control_params(c),
      std::make_unique<pioneer::Connection>(base_connection_config(c), std::move(*base)), w.base_.vitals);
  auto front = connectors("front", c.front.address);
  if (!front) return tl::unexpected(front.error());
  w.front_.worker = std::make_unique<ScanWorker>(
      hand_overs, hand_overs.front, true,
      std::make_unique<hokuyo::Connection>(front_connection_config(c.front), std::move(*front)),
      w.front_.vitals);
  if (c.coronal.present) {
    auto coronal = connectors("coronal", c.coronal.address);
    if (!coronal) return tl::unexpected(coronal.error());
    w.coronal_.worker = std::make_unique<ScanWorker>(
        hand_overs, hand_overs.coronal, false,
        std::make_unique<hokuyo::Connection>(coronal_connection_config(c.coronal), std::move(*coronal)),
        w.coronal_.vitals);
  }
  w.mapping_.worker =
      std::make_unique<MappingWorker>(hand_overs, mapper_params(c), new_maker(c.robot.id), w.mapping_.vitals,
                                      c.team.start.value_or(types::Se2{}), c.team.present);
  const int number = c.team.present ? c.robot.id : PlanningWorker::kNoTeam;
  w.planning_.worker = std::make_unique<PlanningWorker>(
      hand_overs, planner_params(c), types::from_seconds(c.exploration.planning_period_s),
      static_cast<std::uint16_t>(number), w.planning_.vitals);
  w.closure_.worker = std::make_unique<ClosureWorker>(hand_overs, w.closure_.vitals);
  if (!c.session.folder.empty() && c.session.journal) {
    const JournalSettings settings{c.session.folder, types::from_seconds(c.session.journal_period_s),
                                   static_cast<std::size_t>(c.session.keep), params_hash(c),
                                   static_cast<std::uint64_t>(c.session.quota_mb) * 1'000'000U};
    w.journal_.worker = std::make_unique<JournalWorker>(hand_overs, settings, w.journal_.vitals);
  }
  if (c.team.present)
    w.team_.worker = std::make_unique<TeamWorker>(hand_overs, team_settings(c), w.team_.vitals);
  w.list_vitals();
  return made;
}

std::array<Workers::Post*, 8> Workers::posts() {
  return {&base_, &front_, &coronal_, &mapping_, &planning_, &closure_, &journal_, &team_};
}

void Workers::list_vitals() {
  for (Post* post : posts()) {
    if (post->worker == nullptr) continue;
    all_.push_back(&post->vitals);
    if (post != &closure_ && post != &journal_ && post != &team_) vital_.push_back(&post->vitals);
  }
}

ThreadSettings Workers::real_time(int priority) const {
  const RealtimeConfig& config = configuration_.realtime;
  ThreadSettings settings;
  settings.fifo_priority = config.policy == RealtimePolicy::kOff ? 0 : priority;
  settings.cpus = config.cpus;
  return settings;
}

Status Workers::launch(Post& post, ThreadSettings settings) {
  if (post.worker == nullptr) return {};
  settings.name = post.vitals.name;
  return post.thread.start(settings, [settings, &post] {
    for (const std::string& refusal : apply_settings(settings)) {
      if (auto* slot = post.refusals.try_acquire(); slot != nullptr) {
        *slot = refusal;
        post.refusals.commit();
      }
    }
    post.worker->run();
  });
}

Status Workers::start() {
  constexpr std::size_t kLargeStack = 8 << 20;
  constexpr int kBehind = 5;  // niceness: after mapping and planning
  const RealtimeConfig& config = configuration_.realtime;
  const std::array<std::pair<Post*, ThreadSettings>, 8> in_order{{
      {&closure_, {.name = {}, .nice = kBehind, .cpus = {}, .stack_bytes = kLargeStack}},
      {&mapping_, {.name = {}, .cpus = {}, .stack_bytes = kLargeStack}},
      {&planning_, {.name = {}, .cpus = {}, .stack_bytes = kLargeStack}},
      {&journal_, {.name = {}, .nice = kBehind, .cpus = {}}},
      {&team_, {.name = {}, .cpus = {}}},
      {&coronal_, real_time(config.scan_priority)},
      {&front_, real_time(config.scan_priority)},
      {&base_, real_time(config.base_priority)},
  }};
  for (const auto& [post, settings] : in_order) {
    if (auto started = launch(*post, settings); !started) return started;
  }
  return {};
}

void Workers::close_devices() {
  hand_overs_.ending.devices_closing.store(true, std::memory_order_release);
  base_.thread.join();
  front_.thread.join();
  coronal_.thread.join();
}

void Workers::stop() {
  close_devices();
  hand_overs_.ending.stopping.store(true, std::memory_order_release);
  hand_overs_.to_planning.wakeup.post();
  hand_overs_.closure.wakeup.post();
  hand_overs_.journal.wakeup.post();
  hand_overs_.team.wakeup.post();
  closure_.thread.join();
  planning_.thread.join();
  team_.thread.join();
  journal_.thread.join();  // the mapping thread answers it to the end
  hand_overs_.ending.readers_gone.store(true, std::memory_order_release);
  hand_overs_.mapping.wakeup.post();
  mapping_.thread.join();
}

std::vector<std::string> Workers::take_refusals() {
  std::vector<std::string> texts;
  for (Post* post : posts()) {
    auto& refusals = post->refusals;
    for (const auto* text = refusals.front(); text != nullptr; text = refusals.front()) {
      texts.push_back(text->str());
      refusals.pop();
    }
  }
  return texts;
}

}  // namespace topo::daemon
