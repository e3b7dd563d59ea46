// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/credentials.hpp"

#include <fmt/format.h>
#include <grp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace topo::daemon {

types::Result<Peer> peer_of(int socket) {
  ucred credentials{};
  socklen_t size = sizeof credentials;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &credentials, &size) != 0) {
    return types::fail(types::Errc::kIo, fmt::format("credentials of a client: {}", std::strerror(errno)),
                       errno);
  }
  Peer peer{credentials.uid, credentials.gid, credentials.pid, {}};
  // NGROUPS_MAX is 65536; a user in more than 256 groups needs the required one as the primary group.
  std::array<gid_t, 256> groups{};
  size = sizeof groups;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size) == 0) {
    peer.groups.assign(groups.begin(), groups.begin() + size / sizeof(gid_t));
  }
  return peer;
}

std::optional<gid_t> find_group(const std::string& name) {
  const group* entry = ::getgrnam(name.c_str());
  if (entry == nullptr) return {};
  return entry->gr_gid;
}

bool may_command(const Peer& peer, uid_t own_uid, std::optional<gid_t> group) {
  if (peer.uid == 0 || peer.uid == own_uid) return true;
  if (!group) return false;
  return peer.gid == *group || std::find(peer.groups.begin(), peer.groups.end(), *group) != peer.groups.end();
}

}  // namespace topo::daemon
