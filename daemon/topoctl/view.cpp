// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "daemon/topoctl/commands.hpp"

namespace topo::daemon {

/// The tokens are topoview's, which is a package of its own and beside this program where it is installed.
int pair_browser(const Arguments& arguments) {
  std::error_code failed;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
  std::string program = (here / "topoview").string(), config = arguments.view.config,
              name = arguments.view.name;
  std::string config_flag = "--config", pair = "pair", name_flag = "--name";
  std::array<char*, 7> words{program.data(),   config_flag.data(), config.data(), pair.data(),
                             name_flag.data(), name.data(),        nullptr};
  ::execv(program.c_str(), words.data());
  fmt::print(stderr, "topoctl: {}: {}; the page is in the package topometric-view\n", program,
             std::strerror(errno));
  return kFailed;
}

}  // namespace topo::daemon
