// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace topo::daemon {

/// Splits a stream of bytes into lines, with at most `limit` bytes of one unfinished line.
class LineBuffer {
 public:
  explicit LineBuffer(std::size_t limit) : limit_(limit) {}

  /// False when an unfinished line exceeds the limit: the stream is unusable.
  [[nodiscard]] bool append(std::string_view bytes) {
    buffer_.append(bytes);
    return buffer_.find('\n') != std::string::npos || buffer_.size() <= limit_;
  }

  /// The oldest complete line without its line feed.
  std::optional<std::string> take_line() {
    const std::size_t end = buffer_.find('\n');
    if (end == std::string::npos) return {};
    std::string line = buffer_.substr(0, end);
    buffer_.erase(0, end + 1);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  [[nodiscard]] std::size_t size() const { return buffer_.size(); }

 private:
  std::size_t limit_;
  std::string buffer_;
};

}  // namespace topo::daemon
