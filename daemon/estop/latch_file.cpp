// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/latch_file.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <string_view>

#include "daemon/mapfile/atomic_file.hpp"
#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {
namespace {

constexpr std::string_view kMark = "topometric e-stop 1\n";

FoundLatch damaged(const std::string& what) { return {true, what, true}; }

}  // namespace

std::string latch_path(const std::string& folder) { return folder + "/estop.latch"; }

std::string silence_path(const std::string& folder) { return folder + "/silence.latch"; }

FoundLatch read_latch(const std::string& path) {
  // O_NONBLOCK: whatever is there in place of a file must not hold up the start.
  const io::UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (!fd.valid() && (errno == ENOENT || errno == ENOTDIR)) return {};
  if (!fd.valid()) return damaged(io::error_of_errno(path, "cannot be read", errno).message);
  std::array<char, 512> bytes{};
  const auto got = io::retry_interrupted([&] { return ::read(fd.get(), bytes.data(), bytes.size()); });
  if (got < 0) return damaged(io::error_of_errno(path, "cannot be read", errno).message);
  const std::string_view text(bytes.data(), static_cast<std::size_t>(got));
  const bool whole = text.starts_with(kMark) && text.size() > kMark.size() && text.back() == '\n';
  if (!whole) {
    return damaged(fmt::format("{}: damaged: found {} bytes, expected \"{}\" and a line with the reason",
                               path, got, kMark.substr(0, kMark.size() - 1)));
  }
  return {true, std::string(text.substr(kMark.size(), text.size() - kMark.size() - 1)), false};
}

types::Status keep_latch(const std::string& path, const std::string& reason) {
  const std::string text =
      fmt::format("{}{:%Y-%m-%dT%H:%M:%S}Z {}\n", kMark, fmt::gmtime(std::time(nullptr)), reason);
  return write_file(path, text);
}

types::Status remove_latch(const std::string& path) { return remove_file(path); }

}  // namespace topo::daemon
