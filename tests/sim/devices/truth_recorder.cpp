// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/truth_recorder.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim {

types::Status TruthRecorder::open(const std::filesystem::path& file, std::size_t robots,
                                  const std::string& difficulty) {
  for (std::size_t i = 0; i < robots; ++i) {
    const std::string name = robots == 1 ? file.string() : file.string() + "." + std::to_string(i);
    files_.emplace_back(name);
    if (!files_.back()) {
      return types::fail(errno == EACCES ? types::Errc::kPermission : types::Errc::kIo,
                         name + ": cannot write the truth: " + std::strerror(errno), errno);
    }
    files_.back() << "# " << difficulty << "\n# t_s (CLOCK_MONOTONIC)\tx_m\ty_m\ttheta_rad\n";
  }
  return {};
}

void TruthRecorder::record(const Simulation& simulation, double epoch_s) {
  constexpr SimTime kPeriod = std::chrono::milliseconds{100};
  if (files_.empty() || simulation.now() < next_) return;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const Se2 pose = simulation.body(i).pose_at(next_);
    std::array<char, 128> line{};
    std::snprintf(line.data(), line.size(), "%.6f\t%.5f\t%.5f\t%.6f\n", epoch_s + seconds_of(next_), pose.x_m,
                  pose.y_m, pose.theta_rad);
    files_[i] << line.data() << std::flush;
  }
  next_ += kPeriod;
}

}  // namespace topo::sim
