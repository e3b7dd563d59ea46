// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

/// The command line of `topobench session`.
struct SessionCommand {
  std::string log;
  std::vector<double> beams_deg;  ///< START and STEP of the log's beams; empty: the log's or its scanner's
  std::string out;                ///< file for the session; empty: none
  int localise = 200;             ///< scans of the log that are looked for in its map
  bool json = false;
};

/// Maps a log, measures what the codec and the session's file make of its keyframes, and looks for scans that
/// are no keyframes in the whole map, as a robot would that was switched on there.
types::Status run_session(const SessionCommand& command);

}  // namespace topo::bench
