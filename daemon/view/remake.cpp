// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/remake.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "daemon/config/edit.hpp"
#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/input_file.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Status;

constexpr std::size_t kMaxConfigBytes = 1U << 20U;

/// The daemon of the same version, beside this program.
std::string daemon_path() {
  std::error_code failed;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", failed);
  return (self.parent_path() / "topometricd").string();
}

}  // namespace

types::Result<Remake> Remake::start(const std::string& config, const std::string& recording) {
  std::error_code failed;
  std::string folder = (std::filesystem::temp_directory_path(failed) / "topoview-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr)
    return fail(Errc::kIo, fmt::format("{}: {}", folder, std::generic_category().message(errno)), errno);
  Remake remake(recording, folder);
  if (auto running = remake.run(config); !running) return tl::unexpected(running.error());
  return remake;
}

Status Remake::run(const std::string& config) {
  const auto text = read_file(config, kMaxConfigBytes);
  if (!text) return tl::unexpected(text.error());
  const std::array<KeyEdit, 1> edits{{{"control.socket", fmt::format("\"{}/replay.sock\"", folder_)}}};
  const std::string own = folder_ + "/replay.toml";
  const std::string edited_text = edited(*text, edits);
  if (auto written = write_file(own, std::string_view(edited_text)); !written) return written;
  const std::string program = daemon_path();
  const auto cannot = [&program](int error) {
    return fail(Errc::kNotFound,
                fmt::format("{}: {}; it makes a session of a recording", program,
                            std::generic_category().message(error)),
                error);
  };
  if (::access(program.c_str(), X_OK) != 0) return cannot(errno);
  // util-linux: it ends with this program, whatever ends this.
  std::array<std::string, 10> words{"setpriv", "--pdeathsig", "TERM",     program,      "--config",
                                    own,       "--replay",    recording_, "--sessions", folder_};
  std::array<char*, words.size() + 1> arguments{};  // ends with a null pointer
  std::ranges::transform(words, arguments.begin(), [](std::string& word) { return word.data(); });
  const int error =
      ::posix_spawnp(&child_, words.front().c_str(), nullptr, nullptr, arguments.data(), ::environ);
  if (error == 0) return {};
  child_ = 0;
  return cannot(error);
}

bool Remake::is_running() {
  if (child_ != 0 && ::waitpid(child_, nullptr, WNOHANG) != 0) child_ = 0;
  return child_ != 0;
}

Remake::~Remake() {
  if (child_ != 0 && ::kill(child_, SIGTERM) == 0) ::waitpid(child_, nullptr, 0);
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

}  // namespace topo::daemon
