// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"

namespace topo::daemon {

// topoview pair, tokens and revoke: what they print goes to standard output.

/// Makes a token and prints it, and the address that carries it to a browser. kInvalidInput for a name that
/// is taken or none.
types::Status pair_browser(const ViewConfig& view, const std::string& name);
types::Status list_tokens(const ViewConfig& view);
/// kNotFound when there is none of this name.
types::Status revoke_token(const ViewConfig& view, const std::string& name);

}  // namespace topo::daemon
