// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/recording_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>

#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::Error;
using types::Result;
using types::Status;

Error RecordingReader::wrong(std::uint64_t offset, std::string_view found, std::string_view expected) const {
  return {Errc::kInvalidInput,
          fmt::format("{}: at byte {}: found {}, expected {}", path_, offset, found, expected), 0};
}

Result<std::shared_ptr<const RecordingReader>> RecordingReader::open(const std::string& path) {
  io::UniqueFd fd(io::retry_interrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); }));
  if (!fd.valid()) return io::fail_errno(path, "cannot open the recording", errno);
  std::shared_ptr<RecordingReader> reader(new RecordingReader(path, std::move(fd)));
  if (auto s = reader->read_header(); !s.has_value()) return tl::unexpected(s.error());
  if (auto s = reader->index_frames(); !s.has_value()) return tl::unexpected(s.error());
  return std::shared_ptr<const RecordingReader>(std::move(reader));
}

Result<std::size_t> RecordingReader::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  std::size_t done = 0;
  while (done < out.size()) {
    const auto n = io::retry_interrupted([&] {
      return ::pread(fd_.get(), out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    });
    if (n < 0) return io::fail_errno(path_, fmt::format("cannot read at byte {}", offset + done), errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

Status RecordingReader::read_header() {
  std::vector<std::byte> start(16 + kMaxHeaderBody + 8);
  const auto n = read_at(0, start);
  if (!n.has_value()) return tl::unexpected(n.error());
  auto decoded = decode_header(std::span(start).first(*n));
  if (!decoded.header.has_value()) {
    return tl::unexpected(wrong(decoded.fault.offset, decoded.fault.found, decoded.fault.expected));
  }
  header_ = std::move(*decoded.header);
  first_frame_ = decoded.bytes;
  return {};
}

Status RecordingReader::index_frames() {
  const auto end = ::lseek(fd_.get(), 0, SEEK_END);
  if (end < 0) return io::fail_errno(path_, "cannot find the end", errno);
  const auto size = static_cast<std::uint64_t>(end);
  std::uint64_t expected_number = 0;
  for (std::uint64_t at = first_frame_; at < size;) {
    std::array<std::byte, FrameHead::kSize> bytes{};
    const auto n = read_at(at, bytes);
    if (!n.has_value()) return tl::unexpected(n.error());
    if (*n < bytes.size()) {
      damage_ = wrong(at, fmt::format("the last {} bytes of the file", *n),
                      fmt::format("a frame head of {}", bytes.size()));
      return {};
    }
    const auto head = decode_frame_head(bytes);
    if (!head.has_value() || head->number < expected_number) {
      damage_ = wrong(at, "damaged bytes", fmt::format("frame {} or a later one", expected_number));
      return {};
    }
    const std::uint64_t next = at + FrameHead::kSize + head->packed_bytes;
    if (next > size) {
      damage_ = wrong(at, fmt::format("a frame that is cut after {} bytes", size - at),
                      fmt::format("{} bytes", next - at));
      return {};
    }
    missing_frames_ += head->number - expected_number;
    expected_number = head->number + 1;
    frames_.push_back({at, *head});
    at = next;
  }
  return {};
}

std::optional<std::size_t> RecordingReader::channel(std::string_view name) const {
  const auto found = std::find(header_.channels.begin(), header_.channels.end(), name);
  if (found == header_.channels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header_.channels.begin());
}

void RecordingCursor::FreeContext::operator()(ZSTD_DCtx_s* context) const { ZSTD_freeDCtx(context); }

RecordingCursor::RecordingCursor(std::shared_ptr<const RecordingReader> reader,
                                 std::optional<std::size_t> channel)
    : reader_(std::move(reader)),
      channel_(channel),
      context_(ZSTD_createDCtx()),
      packed_(kMaxFrameBytes),
      raw_(kMaxFrameBytes) {}

Status RecordingCursor::load(std::uint64_t offset, const FrameHead& head) {
  const std::uint64_t begin = offset + FrameHead::kSize;
  const auto packed = std::span(packed_).first(head.packed_bytes);
  const auto n = reader_->read_at(begin, packed);
  if (!n.has_value()) return tl::unexpected(n.error());
  if (*n < packed.size() || checksum(packed) != head.checksum) {
    return tl::unexpected(reader_->wrong(begin, fmt::format("frame {} with a wrong checksum", head.number),
                                         "the one of its head"));
  }
  const std::size_t raw =
      ZSTD_decompressDCtx(context_.get(), raw_.data(), raw_.size(), packed.data(), packed.size());
  if (ZSTD_isError(raw) != 0U || raw != head.raw_bytes) {
    return tl::unexpected(reader_->wrong(begin, fmt::format("frame {} that does not unpack", head.number),
                                         fmt::format("{} bytes", head.raw_bytes)));
  }
  rest_ = std::span(raw_).first(raw);
  return {};
}

Result<bool> RecordingCursor::load_next_frame() {
  while (next_frame_ < reader_->frames_.size()) {
    const auto& frame = reader_->frames_[next_frame_++];
    if (channel_.has_value() && (frame.head.channel_mask >> *channel_ & 1U) == 0) continue;
    if (auto s = load(frame.offset, frame.head); !s.has_value()) return tl::unexpected(s.error());
    return true;
  }
  return false;
}

Result<std::optional<Record>> RecordingCursor::next() {
  while (true) {
    if (rest_.empty()) {
      const auto loaded = load_next_frame();
      if (!loaded.has_value()) return tl::unexpected(loaded.error());
      if (!*loaded) return std::optional<Record>{};
      continue;
    }
    const auto head = decode_record_head(rest_);
    if (!head.has_value() || head->length > rest_.size() - RecordHead::kSize ||
        head->channel >= reader_->header_.channels.size()) {
      rest_ = {};
      const auto& frame = reader_->frames_[next_frame_ - 1];
      return tl::unexpected(reader_->wrong(frame.offset,
                                           fmt::format("frame {} with a damaged record", frame.head.number),
                                           "whole records of known channels"));
    }
    const auto bytes = rest_.subspan(RecordHead::kSize, head->length);
    rest_ = rest_.subspan(RecordHead::kSize + head->length);
    if (head->kind != RecordKind::kEnd && channel_.has_value() && head->channel != *channel_) continue;
    return std::optional(Record{head->channel, head->kind, head->stamp, bytes});
  }
}

}  // namespace topo::daemon
