// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/carmen/decompress.hpp"

namespace topo::bench {

/// Reads the lines of a text file, compressed or not. Used by one thread.
class LineSource {
 public:
  static constexpr std::size_t kMaxLine = 1U << 20U;  ///< much longer than any message of a robot's log

  static types::Result<LineSource> open(const std::string& path);
  /// Reads the lines of any content; `name` replaces the file's name in messages.
  static LineSource over(std::string name, std::unique_ptr<ByteSource> source);

  /// The next line without its end ("\n" or "\r\n"), valid until the next call; nothing at the end of the
  /// file. A byte order mark of UTF-8 is no part of the first line; text in UTF-16 is refused.
  types::Result<std::optional<std::string_view>> next();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int line() const { return line_; }  ///< number of the last line, from 1
  /// The last line has no end, as when its writer was interrupted.
  [[nodiscard]] bool is_cut() const { return !terminated_; }

  /// kInvalidInput with "FILE:LINE: found WHAT, expected WHAT" for the last line.
  [[nodiscard]] tl::unexpected<types::Error> bad(std::string_view found, std::string_view expected) const;

 private:
  LineSource(std::string path, std::unique_ptr<ByteSource> source);
  types::Result<bool> refill();
  types::Result<std::string_view> finished(std::string_view line);

  std::string path_;
  std::unique_ptr<ByteSource> source_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  int line_ = 0;
  bool terminated_ = true;  ///< false: the last line has no end, as when its writer was interrupted
};

}  // namespace topo::bench
