// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/line_source.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace topo::bench {

using types::Errc;
using types::fail;
using types::Result;

namespace {

constexpr std::size_t kBlock = 65536;

std::string_view without_carriage_return(std::string_view text) {
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

}  // namespace

LineSource::LineSource(std::string path, std::unique_ptr<ByteSource> source)
    : path_(std::move(path)), source_(std::move(source)), buffer_(kBlock) {}

Result<LineSource> LineSource::open(const std::string& path) {
  auto source = open_source(path);
  if (!source.has_value()) return tl::unexpected(source.error());
  return LineSource(path, std::move(*source));
}

LineSource LineSource::over(std::string name, std::unique_ptr<ByteSource> source) {
  return {std::move(name), std::move(source)};
}

Result<bool> LineSource::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());  // at most to twice the longest line
  const auto n = source_->read(std::span(buffer_).subspan(end_));
  if (!n.has_value()) return tl::unexpected(n.error());
  end_ += *n;
  return *n > 0;
}

Result<std::optional<std::string_view>> LineSource::next() {
  std::size_t searched = 0;
  while (true) {
    const std::string_view rest(buffer_.data() + begin_, end_ - begin_);
    const std::size_t length = rest.find('\n', searched);
    if (length <= kMaxLine) {  // implies found: npos is greater
      begin_ += length + 1;
      return finished(rest.substr(0, length));
    }
    if (rest.size() > kMaxLine) {
      ++line_;
      return bad(fmt::format("a line of more than {} bytes", kMaxLine), "lines of text");
    }
    searched = rest.size();
    const auto more = refill();
    if (!more.has_value()) return tl::unexpected(more.error());
    if (!*more) break;
  }
  const std::string_view rest(buffer_.data() + begin_, end_ - begin_);
  if (rest.empty()) return std::optional<std::string_view>{};
  begin_ = end_;
  terminated_ = false;
  return finished(rest);
}

Result<std::string_view> LineSource::finished(std::string_view line) {
  constexpr std::string_view kUtf8 = "\xEF\xBB\xBF", kUtf16 = "\xFF\xFE", kUtf16BigEndian = "\xFE\xFF";
  ++line_;
  if (line_ == 1) {
    if (line.starts_with(kUtf16) || line.starts_with(kUtf16BigEndian)) return bad("text in UTF-16", "UTF-8");
    if (line.starts_with(kUtf8)) line.remove_prefix(kUtf8.size());
  }
  return without_carriage_return(line);
}

tl::unexpected<types::Error> LineSource::bad(std::string_view found, std::string_view expected) const {
  return fail(Errc::kInvalidInput,
              fmt::format("{}:{}: found {}{}, expected {}", path_, line_, found,
                          terminated_ ? "" : " in a last line without end (truncated file)", expected));
}

}  // namespace topo::bench
