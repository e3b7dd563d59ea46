// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/carmen/decompress.hpp"

namespace topo::daemon {

/// The lines of a text file, packed or not, one after the other. One thread uses it.
class LineSource {
 public:
  static constexpr std::size_t kMaxLine = 1U << 20U;  ///< no message of a robot's log comes near it

  static types::Result<LineSource> open(const std::string& path);
  /// Lines of any content; `name` stands for the file in messages.
  static LineSource over(std::string name, std::unique_ptr<ByteSource> source);

  /// The next line without its end ("\n" or "\r\n"), valid until the next call; nothing at the end of the
  /// file.
  types::Result<std::optional<std::string_view>> next();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int line() const { return line_; }  ///< number of the line given last, from 1

  /// kInvalidInput with "FILE:LINE: found WHAT, expected WHAT" for the line given last.
  [[nodiscard]] tl::unexpected<types::Error> bad(std::string_view found, std::string_view expected) const;

 private:
  LineSource(std::string path, std::unique_ptr<ByteSource> source);
  types::Result<bool> refill();

  std::string path_;
  std::unique_ptr<ByteSource> source_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  int line_ = 0;
  bool terminated_ = true;  ///< false: the last line has no end, as a writer that was cut off leaves it
};

}  // namespace topo::daemon
