// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/types/stamp.hpp"

namespace topo::daemon {

/// Lets a few lines a minute through: with the interface down DDS complains at every packet.
class LineLimit {
 public:
  struct Params {
    int lines = 5;
    types::Duration period = std::chrono::minutes(1);
  };
  LineLimit() = default;
  explicit LineLimit(const Params& params) : params_(params) {}
  /// The line, with how many were left out before it; nothing when there were enough.
  [[nodiscard]] std::optional<std::string> pass(types::Stamp now, std::string_view line);

 private:
  Params params_;
  types::Stamp begin_{};
  int passed_ = 0;
  int left_out_ = 0;
};

/// True when a line of Cyclone's says that it refused another participant for its credentials, or a writer of
/// one for its permissions: what it tells of that, it tells here only.
[[nodiscard]] bool is_refusal(std::string_view line);

/// What Cyclone DDS says goes to the log, warnings as warnings, a few lines a minute. `refused` is called for
/// each refusal, logged or not, by any of its threads.
void log_of_dds(std::function<void()> refused);

/// Nothing of it goes there any more: before the log ends.
void end_log_of_dds();

}  // namespace topo::daemon
