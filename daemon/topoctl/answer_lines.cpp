// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/answer_lines.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>

#include "drivers/io/posix.hpp"

namespace topo::daemon {

void AnswerLines::fill() {
  if (ended_ || io::wait_for(fd_, POLLIN, types::Duration::zero()) <= 0) return;
  std::array<char, 512> bytes{};
  const ssize_t got = io::retry_interrupted([&] { return ::read(fd_, bytes.data(), bytes.size()); });
  if (got <= 0)
    ended_ = true;
  else
    buffer_.append(bytes.data(), static_cast<std::size_t>(got));
}

std::optional<std::string> AnswerLines::next() {
  if (buffer_.find('\n') == std::string::npos) fill();
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos && !(ended_ && !buffer_.empty())) return std::nullopt;
  std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end == std::string::npos ? end : end + 1);
  return line;
}

}  // namespace topo::daemon
