// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"

namespace topo::bench {

struct PosegraphCommand {
  std::string file;
  bool robust = false;  ///< edges between other than successive nodes under the closures' loss
  bool json = false;
};

/// `topobench posegraph`: solves a pose graph from its dead reckoning and prints the report of REPORTS
/// "topobench posegraph".
types::Status run_posegraph(const PosegraphCommand& command);

}  // namespace topo::bench
