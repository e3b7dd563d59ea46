// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/request_check.hpp"

#include <arpa/inet.h>

#include <algorithm>

namespace topo::daemon {
namespace {

constexpr std::size_t kLongest = 260;  ///< a name of DNS has at most 253 characters, a port five

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(std::string_view a, std::string_view b) { return std::ranges::equal(a, b, {}, lower, lower); }

bool is_port(std::string_view text) {
  constexpr std::size_t kDigitsMax = 5;
  return !text.empty() && text.size() <= kDigitsMax &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

template <int kFamily>
bool is_ip(std::string_view text) {
  in6_addr address{};  // large enough for both families
  return ::inet_pton(kFamily, std::string(text).c_str(), &address) == 1;
}

}  // namespace

bool is_own_host(std::string_view host, const std::vector<std::string>& names) {
  if (host.empty() || host.size() > kLongest) return false;
  if (host.front() == '[') {  // an IPv6 address
    const std::size_t end = host.find(']');
    if (end == std::string_view::npos || !is_ip<AF_INET6>(host.substr(1, end - 1))) return false;
    const std::string_view rest = host.substr(end + 1);
    return rest.empty() || (rest.front() == ':' && is_port(rest.substr(1)));
  }
  const std::size_t colon = host.find(':');
  if (colon != std::string_view::npos && !is_port(host.substr(colon + 1))) return false;
  const std::string_view name = host.substr(0, colon);
  return is_ip<AF_INET>(name) || same_word(name, "localhost") ||
         std::ranges::any_of(names, [name](const std::string& own) { return same_word(own, name); });
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme) && same_word(origin.substr(scheme.size()), host)) return true;
  }
  return false;
}

}  // namespace topo::daemon
