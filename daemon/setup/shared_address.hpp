// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "drivers/io/neighbours.hpp"

namespace topo::daemon {

/// What to say when several devices answer for one address, as two scanners from the factory do, with the
/// cure; empty when at most one does.
[[nodiscard]] std::string shared_address(const std::string& address,
                                         std::span<const io::Neighbour> neighbours);

}  // namespace topo::daemon
