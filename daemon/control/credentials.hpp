// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

/// The peer of a Unix socket as reported by the kernel (SO_PEERCRED, SO_PEERGROUPS): the peer cannot forge
/// it.
struct Peer {
  uid_t uid = static_cast<uid_t>(-1);
  gid_t gid = static_cast<gid_t>(-1);
  pid_t pid = 0;
  std::vector<gid_t> groups;  ///< supplementary
};

types::Result<Peer> peer_of(int socket);

/// The group's number; nothing when the group does not exist.
std::optional<gid_t> find_group(const std::string& name);

/// Root, the daemon's own user and members of `group` may command. Any other user may query and e-stop.
bool may_command(const Peer& peer, uid_t own_uid, std::optional<gid_t> group);

}  // namespace topo::daemon
