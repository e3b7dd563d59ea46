// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/line.hpp"

#include <algorithm>
#include <utility>

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;

/// A request has at most 48 bytes ($IP): a device that does not accept them at once is faulty.
constexpr types::Duration kWriteLimit = 20ms;

}  // namespace

void Line::open(std::unique_ptr<io::ByteStream> stream) {
  stream_ = std::move(stream);
  parser_.reset();
  begin_ = end_ = 0;
  sample_size_ = 0;
}

types::Status Line::send(std::string_view request) {
  std::array<char, 64> text{};
  const std::size_t size = std::min(request.size(), text.size() - 1);
  std::copy_n(request.data(), size, text.data());
  text[size] = '\n';
  return stream_->write(std::as_bytes(std::span(text.data(), size + 1)), kWriteLimit);
}

types::Result<ScipParser::Event> Line::poll(types::Stamp until) {
  for (bool waited = false;;) {
    if (begin_ == end_) {
      const types::Duration left = until - now();
      if (waited && left <= 0ns) return ScipParser::Event::kNone;
      waited = true;
      auto got = stream_->read(buffer_, std::max(left, 0ns));
      if (!got) return tl::unexpected<types::Error>(std::move(got.error()));
      if (got->bytes == 0) return ScipParser::Event::kNone;
      begin_ = 0;
      end_ = std::min(got->bytes, buffer_.size());
      arrival_ = got->stamp;
      bytes_ += got->bytes;
      note_sample(std::span(buffer_).first(end_));
    }
    const auto progress = parser_.feed(std::span(buffer_).subspan(begin_, end_ - begin_));
    begin_ += progress.consumed;
    if (progress.event != ScipParser::Event::kNone) return progress.event;
  }
}

void Line::note_sample(std::span<const std::byte> bytes) {
  const std::size_t count = std::min(bytes.size(), sample_.size() - sample_size_);
  std::copy_n(bytes.begin(), count, sample_.begin() + static_cast<std::ptrdiff_t>(sample_size_));
  sample_size_ += count;
}

/// Every ARCOS packet begins with FA FB (PROTOCOLS section 1).
bool Line::heard_arcos() const {
  constexpr std::array kHeader{std::byte{0xFA}, std::byte{0xFB}};
  const auto end = sample_.begin() + static_cast<std::ptrdiff_t>(sample_size_);
  return std::search(sample_.begin(), end, kHeader.begin(), kHeader.end()) != end;
}

std::string Line::heard_text() const {
  constexpr std::size_t kShown = 12;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < std::min(sample_size_, kShown); ++i) {
    const auto value = std::to_integer<std::size_t>(sample_[i]);
    if (i > 0) text += ' ';
    text += kDigits[value >> 4U];
    text += kDigits[value & 0xFU];
  }
  return text;
}

}  // namespace topo::hokuyo
