// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/hand_overs.hpp"

#include "core/pipeline/mapping_step.hpp"

namespace topo::daemon {

MappingHandOver::MappingHandOver() : map(std::make_unique<MapSnapshots>()) {}
MappingHandOver::~MappingHandOver() = default;

}  // namespace topo::daemon
