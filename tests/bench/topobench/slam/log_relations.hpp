// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/relations.hpp"

namespace topo::bench {

/// The relations of a file that are about a log. kInvalidInput when none of them has both its stamps in the
/// log: they are of another building, and errors over none would read as perfect.
types::Result<std::vector<Relation>> read_relations_of(const CarmenLog& log, const std::string& path);

}  // namespace topo::bench
