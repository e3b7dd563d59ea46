// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/map_saver.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <iterator>

#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/cloud.hpp"
#include "daemon/mapfile/map_image.hpp"

namespace topo::daemon {
namespace {

/// The folder itself, not the ones above it: a mistyped path is to be seen, not made.
types::Status make_folder(const std::string& folder) {
  constexpr mode_t kMode = 0775;
  if (::mkdir(folder.c_str(), kMode) == 0 || errno == EEXIST) return {};
  return types::fail(types::Errc::kInvalidInput,
                     fmt::format("{}: cannot make the folder: {}", folder, std::strerror(errno)), errno);
}

/// The way through the keyframes as a text, a line each: stamp on CLOCK_MONOTONIC, x, y, theta of the robot
/// in map.
std::string trajectory_text(const pipeline::MapSnapshot& map) {
  std::string text;
  for (const pipeline::KeyframePose& keyframe : map.keyframes) {
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f} {:.7f}\n",
                   types::to_seconds(keyframe.stamp), keyframe.T_map_base.x_m(), keyframe.T_map_base.y_m(),
                   keyframe.T_map_base.theta_rad());
  }
  return text;
}

}  // namespace

types::Status MapSaver::start() {
  ThreadSettings settings;
  settings.name = "files";
  settings.nice = 5;
  settings.stack_bytes = 4 << 20;
  return thread_.start(settings, [this, settings] {
    (void)apply_settings(settings);
    run();
  });
}

void MapSaver::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  job_ready_.post();
  thread_.join();
}

void MapSaver::save(const std::string& folder, Done done) {
  constexpr std::size_t kMostWaiting = 8;
  const std::lock_guard lock(mutex_);
  if (stopping_ || waiting_.size() >= kMostWaiting) {
    finished_.push_back(
        {folder, std::move(done),
         types::fail(types::Errc::kBusy, "too many maps wait to be saved, or the daemon is stopping")});
    outcome_ready_.post();
    return;
  }
  waiting_.push_back({folder, std::move(done), SavedMap{}});
  job_ready_.post();
}

void MapSaver::collect() {
  outcome_ready_.wait(types::Duration::zero());
  std::deque<Job> finished;
  {
    const std::lock_guard lock(mutex_);
    finished.swap(finished_);
  }
  for (Job& job : finished) job.done(std::move(job.outcome));
}

void MapSaver::run() {
  while (true) {
    job_ready_.wait(std::chrono::seconds(10));
    while (true) {
      Job job;
      {
        const std::lock_guard lock(mutex_);
        if (stopping_) return;
        if (waiting_.empty()) break;
        job = std::move(waiting_.front());
        waiting_.pop_front();
      }
      job.outcome = write(job.folder);
      {
        const std::lock_guard lock(mutex_);
        finished_.push_back(std::move(job));
      }
      outcome_ready_.post();
    }
  }
}

MapSaver::Outcome MapSaver::write(const std::string& folder) {
  const auto snapshot = snapshots_.pin();
  if (!snapshot || snapshot->keyframes.empty()) {
    return types::fail(types::Errc::kNotFound, "there is no map yet: no scan was matched since the start");
  }
  const auto image = image_of(snapshot->grid);
  if (!image) return tl::unexpected(image.error());
  const auto cloud = cloud_of(snapshot->walls);
  if (const auto made = make_folder(folder); !made) return tl::unexpected(made.error());
  if (const auto saved = save_map(folder, *image); !saved) return tl::unexpected(saved.error());
  if (const auto saved = save_cloud(folder + "/cloud.ply", cloud); !saved)
    return tl::unexpected(saved.error());
  if (const auto saved = write_file(folder + "/trajectory.txt", trajectory_text(*snapshot)); !saved)
    return tl::unexpected(saved.error());
  return SavedMap{folder, snapshot->revision, image->width, image->height, cloud.size()};
}

}  // namespace topo::daemon
