// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/cyclone_config.hpp"

#include <fmt/format.h>

#include "daemon/link/team_credentials.hpp"

namespace topo::daemon {
namespace {

/// Participants that a listed host is searched for: robots of a simulation share one.
constexpr int kParticipantsAHost = 16;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// One plugin; Cyclone 0.10 takes a path as it is only when it ends in ".so".
std::string library(const std::string& plugins, const char* file, const char* what) {
  return fmt::format(
      "<Library path=\"{}/lib{}.so\" initFunction=\"init_{}\" finalizeFunction=\"finalize_{}\"/>",
      escaped(plugins), file, what, what);
}

std::string security_part(const std::string& folder, const std::string& plugins) {
  const auto file = [&folder](const char* name) { return "file:" + escaped(folder) + "/" + name; };
  return fmt::format(
      "<Security><Authentication>{}<IdentityCA>{}</IdentityCA><IdentityCertificate>{}</IdentityCertificate>"
      "<PrivateKey>{}</PrivateKey></Authentication><Cryptographic>{}</Cryptographic><AccessControl>{}"
      "<PermissionsCA>{}</PermissionsCA><Governance>{}</Governance><Permissions>{}</Permissions></"
      "AccessControl>"
      "</Security>",
      library(plugins, "dds_security_auth", "authentication"), file(kIdentityCa), file(kCertificate),
      file(kPrivateKey), library(plugins, "dds_security_crypto", "crypto"),
      library(plugins, "dds_security_ac", "access_control"), file(kPermissionsCa), file(kGovernance),
      file(kPermissions));
}

/// With listed peers every participant has one of a few known ports, where the others look for it.
std::string discovery_part(const RadioPlan& plan) {
  if (plan.peers.empty())
    return fmt::format("<DefaultMulticastAddress>{}</DefaultMulticastAddress>", team_group(plan.team));
  std::string peers;
  for (const std::string& peer : plan.peers) peers += fmt::format("<Peer Address=\"{}\"/>", escaped(peer));
  return fmt::format(
      "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</"
      "MaxAutoParticipantIndex><Peers>{}</Peers>",
      kParticipantsAHost - 1, peers);
}

}  // namespace

std::string team_group(std::uint64_t team) {
  return fmt::format("239.192.{}.{}", (team >> 8U) & 0xFFU, team & 0xFFU);
}

std::string cyclone_config(const RadioPlan& plan, const std::string& plugins) {
  // asm: any-source multicast for data, on the team's group. One receive thread: with several, deleting the
  // participant waits for ever for a packet that the thread of the multicast socket sends to itself over an
  // interface that is down.
  // Messages over an Ethernet frame are those of the security handshake alone: some 3 kB, lost when one of
  // their frames is, so as few frames as possible. With 30 % of the frames lost it took 4 s on average in
  // place of 7 s at 1400 bytes.
  const bool multicast = plan.peers.empty();
  return fmt::format(
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"{}\"/></Interfaces>"
      "<AllowMulticast>{}</AllowMulticast><MaxMessageSize>1400B</MaxMessageSize><FragmentSize>1300B</"
      "FragmentSize>"
      "</General><Discovery>{}</Discovery><Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></"
      "Internal>"
      "{}</Domain></CycloneDDS>",
      escaped(plan.interface), multicast ? "spdp,asm" : "false", discovery_part(plan),
      plan.security.empty() ? std::string() : security_part(plan.security, plugins));
}

}  // namespace topo::daemon
