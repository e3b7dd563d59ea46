// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/types/result.hpp"

namespace topo::daemon {

// Files of a robot's credentials, as topometric-team(8) makes them and Cyclone's security plugins read them.
inline constexpr const char* kIdentityCa = "identity-ca.pem";
inline constexpr const char* kCertificate = "identity.pem";
inline constexpr const char* kPrivateKey = "identity-key.pem";
inline constexpr const char* kPermissionsCa = "permissions-ca.pem";
inline constexpr const char* kGovernance = "governance.p7s";
inline constexpr const char* kPermissions = "permissions.p7s";

/// Checks the credentials in `folder` before DDS reads them: all files are there and of this process's user
/// or root, nobody but their owner reads the private key, nobody else writes any of them, and the certificate
/// is valid now and names this team and robot. An error names the first fault found and the command that
/// mends it. `now_s`: seconds since 1970.
[[nodiscard]] types::Status check_credentials(const std::string& folder, const std::string& team, int robot,
                                              std::int64_t now_s);

}  // namespace topo::daemon
