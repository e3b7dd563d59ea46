// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::daemon {

inline constexpr const char* kVersion = TOPO_VERSION;  // version of the CMake project

}  // namespace topo::daemon
