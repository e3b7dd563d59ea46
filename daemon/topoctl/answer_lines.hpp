// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace topo::daemon {

/// Lines of a descriptor, without waiting for one: a terminal, a pipe or a file.
class AnswerLines {
 public:
  explicit AnswerLines(int fd) : fd_(fd) {}

  /// The next line without its end, when there is one. A last line without an end counts.
  [[nodiscard]] std::optional<std::string> next();
  /// True when no line will come any more.
  [[nodiscard]] bool ended() const { return ended_ && buffer_.empty(); }

 private:
  void fill();

  int fd_;
  std::string buffer_;
  bool ended_ = false;
};

}  // namespace topo::daemon
