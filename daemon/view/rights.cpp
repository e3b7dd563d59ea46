// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/rights.hpp"

#include <spdlog/spdlog.h>
#include <sys/stat.h>

namespace topo::daemon {

std::optional<Rights::Version> Rights::version() const {
  struct stat info {};
  if (::stat(tokens_path(folder_).c_str(), &info) != 0) return {};
  return Version{info.st_ino, info.st_mtim.tv_sec, info.st_mtim.tv_nsec};
}

bool Rights::hold(const std::string& hash) {
  const auto present = version();
  if (!present) tokens_.clear();
  if (present && present != read_) {
    auto loaded = load_tokens(folder_);
    if (!loaded) spdlog::error("no token holds: {}", loaded.error().message);
    tokens_ = loaded ? std::move(*loaded) : std::vector<KeptToken>{};
  }
  read_ = present;
  return is_known_hash(tokens_, hash);
}

}  // namespace topo::daemon
