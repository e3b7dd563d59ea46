// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/byte_stream.hpp"

#include "drivers/io/posix.hpp"

namespace topo::io {

Stamp Connector::now() const { return monotonic_now(); }

// A negative descriptor: only the time-out ends the wait.
void Connector::pause(Duration duration) { (void)wait_for(-1, 0, duration); }

}  // namespace topo::io
