// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/view/board.hpp"

namespace topo::daemon {

/// A daemon's answer as pages get it: what they show, and numbers to the thousandth (a millimetre, a
/// millisecond). What changes with every answer and nobody sees, such as counters of bytes, does not go over
/// the network five times a second. Pure.
Json shorten(Topic topic, Json answer);

}  // namespace topo::daemon
