// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

/// Who is at the other end of a Unix socket, as the kernel says (SO_PEERCRED, SO_PEERGROUPS): the peer cannot
/// choose it.
struct Peer {
  uid_t uid = static_cast<uid_t>(-1);
  gid_t gid = static_cast<gid_t>(-1);
  pid_t pid = 0;
  std::vector<gid_t> groups;  ///< supplementary
};

types::Result<Peer> peer_of(int socket);

/// The group's number; nothing when there is no such group here.
std::optional<gid_t> find_group(const std::string& name);

/// Root, the daemon's own user and members of `group` may command. Everybody else may look and e-stop.
bool may_command(const Peer& peer, uid_t own_uid, std::optional<gid_t> group);

}  // namespace topo::daemon
