// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace topo::daemon {

// The example files of config/, which embed_examples.cmake makes part of the program.
extern const std::string_view kExampleP3dx;
extern const std::string_view kExampleP3at;

}  // namespace topo::daemon
