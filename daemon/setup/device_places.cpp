// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/device_places.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <fstream>
#include <set>

namespace topo::daemon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScipPort = "10940";
constexpr int kCanUnits = 8;

std::vector<std::string> matches(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> out;
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0)
    out.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  return out;
}

std::vector<std::string> can_interfaces(const fs::path& folder) {
  constexpr int kArphrdCan = 280;  // linux/if_arp.h
  std::vector<std::string> out;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    std::ifstream file(i->path() / "type");
    int type = 0;
    if (file >> type && type == kArphrdCan) out.push_back(i->path().filename());
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string tcp_address(const std::string& text) {
  if (text.starts_with("tcp:")) return text;
  return text.find(':') == std::string::npos ? fmt::format("tcp:{}:{}", text, kScipPort) : "tcp:" + text;
}

}  // namespace

std::vector<SearchPlace> addresses_of(const SearchPlaces& places) {
  std::vector<SearchPlace> out;
  std::set<std::string> seen;
  for (const std::string& pattern : places.serial) {
    for (const std::string& path : matches(pattern)) {
      std::error_code error;
      const fs::path device = fs::canonical(path, error);
      if (seen.insert(error ? path : device.string()).second) out.push_back({"serial:" + path, false});
    }
  }
  for (const std::string& host : places.tcp)
    if (const std::string address = tcp_address(host); seen.insert(address).second)
      out.push_back({address, false});
  for (const std::string& address : places.bases)
    if (seen.insert(address).second) out.push_back({address, true});
  for (const std::string& interface : can_interfaces(places.network_interfaces)) {
    for (int unit = 0; unit < kCanUnits; ++unit) {
      const std::string address = fmt::format("can:{}:{}", interface, unit);
      if (seen.insert(address).second) out.push_back({address, true});
    }
  }
  return out;
}

}  // namespace topo::daemon
