// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/watch_robot.hpp"

#include <algorithm>
#include <utility>

#include "drivers/pioneer/link.hpp"
#include "drivers/pioneer/listening.hpp"

namespace topo::daemon {

types::Result<StopOutcome> watch_robot(io::Connector& connector, types::Duration limit) {
  const types::Stamp deadline = connector.now() + limit;
  auto stream = connector.connect(limit);
  if (!stream) return tl::unexpected(stream.error());
  pioneer::Counters counters;
  pioneer::Link link(std::move(*stream), counters);
  pioneer::Listening listening(link, 0);
  while (link.now() < deadline && !listening.stands()) {
    if (auto ok = listening.on_time(); !ok) return tl::unexpected(ok.error());
    const auto wait = std::min(deadline, listening.deadline()) - link.now();
    if (auto ok = link.receive(wait); !ok) return tl::unexpected(ok.error());
    while (const auto packet = link.next_packet()) static_cast<void>(listening.on_packet(*packet));
  }
  if (!listening.heard()) return StopOutcome::kSilent;
  return listening.stands() ? StopOutcome::kStands : StopOutcome::kMoves;
}

}  // namespace topo::daemon
