// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/run_program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <system_error>

namespace topo::io {
namespace {

constexpr int kFailed = 1;

/// As gnulib's stdopen: opened in the wrong direction, so that any use is an error.
void occupy(int descriptor, int wrong_direction) {
  if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return;
  [[maybe_unused]] const int taken = ::open("/dev/null", wrong_direction);  // takes the lowest number: this
}

void occupy_standard_streams() {
  occupy(STDIN_FILENO, O_WRONLY);
  occupy(STDOUT_FILENO, O_RDONLY);
  occupy(STDERR_FILENO, O_RDONLY);
}

/// The errno of a failed write to standard output; 0 when it is no longer known.
std::optional<int> lost_output() {
  const bool before = std::ferror(stdout) != 0;
  if (std::fflush(stdout) != 0) return errno;
  return before ? std::optional(0) : std::nullopt;
}

}  // namespace

int run_program(const char* name, int (*start)(int argc, char** argv), int argc, char** argv) {
  occupy_standard_streams();
  int status = kFailed;
  std::optional<int> lost;
  try {
    status = start(argc, argv);
    lost = lost_output();
  } catch (const std::system_error& thrown) {  // fmt::print() throws this when the text exceeds the buffer
    if (std::ferror(stdout) == 0) throw;
    const std::error_code& error = thrown.code();
    lost = error.value();
  }
  if (!lost) return status;
  std::fprintf(stderr, "%s: standard output: cannot be written%s%s\n", name, *lost == 0 ? "" : ": ",
               *lost == 0 ? "" : std::strerror(*lost));
  return status == 0 ? kFailed : status;
}

}  // namespace topo::io
