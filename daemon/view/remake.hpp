// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>
#include <utility>

#include "core/types/result.hpp"

namespace topo::daemon {

/// A session that is made of a recording: a topometricd of its own (--replay, in real time), with a control
/// socket and a folder of its own, so that the robot's own daemon may run beside it. Ends, and removes the
/// folder, with this object; with the calling thread it ends in any case.
class Remake {
 public:
  /// `config`: the configuration's file. kNotFound: there is no topometricd; kIo.
  static types::Result<Remake> start(const std::string& config, const std::string& recording);

  Remake(Remake&& other) noexcept { swap(other); }
  Remake& operator=(Remake&& other) noexcept {
    swap(other);
    return *this;
  }
  Remake(const Remake&) = delete;
  Remake& operator=(const Remake&) = delete;
  ~Remake();

  [[nodiscard]] const std::string& recording() const { return recording_; }
  /// Where its sessions are.
  [[nodiscard]] const std::string& folder() const { return folder_; }
  [[nodiscard]] bool is_running();

 private:
  Remake(std::string recording, std::string folder)
      : recording_(std::move(recording)), folder_(std::move(folder)) {}
  void swap(Remake& other) noexcept {
    recording_.swap(other.recording_);
    folder_.swap(other.folder_);
    std::swap(child_, other.child_);
  }
  types::Status run(const std::string& config);

  std::string recording_, folder_;
  pid_t child_ = 0;  ///< 0: it has ended
};

}  // namespace topo::daemon
