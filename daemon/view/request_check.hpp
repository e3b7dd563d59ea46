// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace topo::daemon {

// Who a browser speaks for. A page of another site may make the operator's browser open connections to a
// robot: it tells its own origin then, which it cannot forge. A site whose name suddenly leads to the robot's
// address (DNS rebinding) is of one origin with it, but its name stands in Host. Pure.

/// True when `host` (of a request, with or without port) is an IP address, localhost or one of `names`, in
/// any case of letters: no name that another site could have made to lead here.
bool is_own_host(std::string_view host, const std::vector<std::string>& names);

/// True when `origin` is empty (no browser sent it) or the page was itself loaded from `host`, over http or,
/// where a proxy stands before it, https.
bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace topo::daemon
