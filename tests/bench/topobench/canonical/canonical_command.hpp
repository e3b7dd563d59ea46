// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

/// The command line of `topobench canonical`.
struct CanonicalCommand {
  std::vector<std::string> sessions;  ///< files, as topoctl session save writes them
};

/// Of each session, what all robots of a team must agree on once they hold the same: the keyframes, the
/// relations, and the canonical maps that follow from these, each as a hash over every bit. The poses of the
/// session itself, which depend on what came when, do not enter. kInvalidInput: a file is no session, or
/// holds no keyframe.
types::Status run_canonical(const CanonicalCommand& command);

}  // namespace topo::bench
