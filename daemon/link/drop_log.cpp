// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/drop_log.hpp"

#include <fmt/format.h>

namespace topo::daemon {
namespace {

constexpr types::Duration kPeriod = std::chrono::minutes(1);

}  // namespace

std::optional<std::string> DropLog::line(types::Stamp now, const LinkStats& stats) {
  if (!last_) {
    last_ = now;
    told_ = stats;
  }
  if (now - *last_ < kPeriod) return {};
  last_ = now;
  std::string kinds;
  for (std::size_t i = 0; i < kLinkDrops; ++i) {
    const std::uint64_t more = stats.dropped[i] - told_.dropped[i];
    if (more > 0)
      kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", more, drop_name(static_cast<LinkDrop>(i)));
  }
  told_ = stats;
  if (kinds.empty()) return {};
  return "dropped in the last minute: " + kinds;
}

}  // namespace topo::daemon
