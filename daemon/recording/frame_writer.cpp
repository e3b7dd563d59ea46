// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/frame_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>

#include "daemon/recording/quota.hpp"
#include "drivers/io/folder_sync.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

namespace {

constexpr int kLevel = 3;  // packs a laser's text to a third, at a few per cent of one core

}  // namespace

void FrameWriter::FreeContext::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

FrameWriter::FrameWriter(std::string path, io::UniqueFd fd)
    : path_(std::move(path)),
      fd_(std::move(fd)),
      context_(ZSTD_createCCtx()),
      frame_(FrameHead::kSize + ZSTD_compressBound(kMaxFrameBytes)) {}

Result<FrameWriter> FrameWriter::create(const std::string& path, const RecordingHeader& header) {
  io::UniqueFd fd(io::retry_interrupted(
      [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644); }));
  if (!fd.valid()) {
    if (errno == EEXIST) {
      return fail(Errc::kInvalidInput,
                  fmt::format("{}: found an existing file, expected a new name for the recording", path),
                  EEXIST);
    }
    return io::fail_errno(path, "cannot create the recording", errno);
  }
  mark_as_written(fd.get());
  FrameWriter writer(path, std::move(fd));
  if (auto s = writer.append(encode_header(header)); !s.has_value()) return tl::unexpected(s.error());
  if (auto s = io::sync_folder_of(path); !s.has_value()) return tl::unexpected(s.error());
  return writer;
}

Status FrameWriter::append(std::span<const std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto n =
        io::retry_interrupted([&] { return ::write(fd_.get(), bytes.data() + done, bytes.size() - done); });
    if (n < 0) {
      const int error = errno;
      const auto end = static_cast<off_t>(size_);
      if (::ftruncate(fd_.get(), end) == 0) static_cast<void>(::lseek(fd_.get(), end, SEEK_SET));
      return io::fail_errno(path_, fmt::format("cannot write {} bytes at byte {}", bytes.size(), size_),
                            error);
    }
    done += static_cast<std::size_t>(n);
  }
  size_ += bytes.size();
  return {};
}

Status FrameWriter::write(std::span<const std::byte> records, std::uint32_t channel_mask) {
  const std::uint64_t number = number_++;
  const auto packed = std::span(frame_).subspan(FrameHead::kSize);
  const std::size_t n =
      ZSTD_compressCCtx(context_.get(), packed.data(), packed.size(), records.data(), records.size(), kLevel);
  if (ZSTD_isError(n) != 0U)
    return fail(Errc::kIo, fmt::format("{}: cannot pack a frame: {}", path_, ZSTD_getErrorName(n)));
  const auto head =
      encode_frame_head({static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(records.size()),
                         channel_mask, number, checksum(packed.first(n))});
  std::copy(head.begin(), head.end(), frame_.begin());
  return append(std::span(frame_).first(FrameHead::kSize + n));
}

Status FrameWriter::sync() {
  if (::fdatasync(fd_.get()) != 0 && errno != EINVAL)
    return io::fail_errno(path_, "cannot bring it to the disk", errno);
  return {};
}

}  // namespace topo::daemon
