// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/decompress.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace topo::bench {

using types::Errc;
using types::fail;
using types::Result;

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// The file's bytes without decompression, in blocks.
class RawFile {
 public:
  RawFile(std::string path, File file) : path_(std::move(path)), file_(std::move(file)) {}

  Result<std::size_t> read(std::span<char> buffer) {
    const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file_.get());
    if (n == 0 && std::ferror(file_.get()) != 0) {
      return fail(Errc::kIo, fmt::format("{}: cannot read: {}", path_, std::strerror(errno)), errno);
    }
    offset_ += n;
    return n;
  }
  void rewind() {
    std::rewind(file_.get());
    offset_ = 0;
  }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::string path_;
  File file_;
  std::size_t offset_ = 0;
};

class PlainSource final : public ByteSource {
 public:
  explicit PlainSource(RawFile file) : file_(std::move(file)) {}
  Result<std::size_t> read(std::span<char> buffer) override { return file_.read(buffer); }

 private:
  RawFile file_;
};

enum class Step { kMore, kMemberEnd, kBroken };

/// zlib's decoder with the interface that PackedSource needs.
class Gzip {
 public:
  Gzip() { ok_ = inflateInit2(&z_, 16 + MAX_WBITS) == Z_OK; }
  ~Gzip() { inflateEnd(&z_); }
  Gzip(const Gzip&) = delete;
  Gzip& operator=(const Gzip&) = delete;

  static constexpr std::string_view kName = "gzip";
  [[nodiscard]] std::size_t pending() const { return z_.avail_in; }
  void feed(std::span<char> in) {
    z_.next_in = reinterpret_cast<Bytef*>(in.data());
    z_.avail_in = static_cast<uInt>(in.size());
  }
  void restart() { ok_ = inflateReset(&z_) == Z_OK; }
  Step step(std::span<char> out, std::size_t& produced) {
    z_.next_out = reinterpret_cast<Bytef*>(out.data());
    z_.avail_out = static_cast<uInt>(out.size());
    const int rc = ok_ ? inflate(&z_, Z_NO_FLUSH) : Z_STREAM_ERROR;
    produced = out.size() - z_.avail_out;
    if (rc == Z_STREAM_END) return Step::kMemberEnd;
    return rc == Z_OK || rc == Z_BUF_ERROR ? Step::kMore : Step::kBroken;
  }

 private:
  z_stream z_{};
  bool ok_ = false;
};

/// libbz2's decoder with the same interface.
class Bzip2 {
 public:
  Bzip2() { ok_ = BZ2_bzDecompressInit(&z_, 0, 0) == BZ_OK; }
  ~Bzip2() { BZ2_bzDecompressEnd(&z_); }
  Bzip2(const Bzip2&) = delete;
  Bzip2& operator=(const Bzip2&) = delete;

  static constexpr std::string_view kName = "bzip2";
  [[nodiscard]] std::size_t pending() const { return z_.avail_in; }
  void feed(std::span<char> in) {
    z_.next_in = in.data();
    z_.avail_in = static_cast<unsigned>(in.size());
  }
  void restart() {
    const bz_stream old = z_;
    BZ2_bzDecompressEnd(&z_);
    z_ = bz_stream{};
    ok_ = BZ2_bzDecompressInit(&z_, 0, 0) == BZ_OK;
    z_.next_in = old.next_in;
    z_.avail_in = old.avail_in;
  }
  Step step(std::span<char> out, std::size_t& produced) {
    z_.next_out = out.data();
    z_.avail_out = static_cast<unsigned>(out.size());
    const int rc = ok_ ? BZ2_bzDecompress(&z_) : BZ_PARAM_ERROR;
    produced = out.size() - z_.avail_out;
    if (rc == BZ_STREAM_END) return Step::kMemberEnd;
    return rc == BZ_OK ? Step::kMore : Step::kBroken;
  }

 private:
  bz_stream z_{};
  bool ok_ = false;
};

template <class Codec>
class PackedSource final : public ByteSource {
 public:
  explicit PackedSource(RawFile file) : file_(std::move(file)) {}

  Result<std::size_t> read(std::span<char> buffer) override {
    while (true) {
      if (codec_.pending() == 0) {
        auto n = file_.read(in_);
        if (!n.has_value()) return n;
        if (*n == 0) return at_file_end();
        codec_.feed(std::span(in_).first(*n));
      }
      if (!in_member_) codec_.restart();
      in_member_ = true;
      std::size_t produced = 0;
      const Step step = codec_.step(buffer, produced);
      if (step == Step::kBroken) return damaged("damaged");
      if (step == Step::kMemberEnd) in_member_ = false;
      if (produced > 0) return produced;
    }
  }

 private:
  Result<std::size_t> at_file_end() {
    if (in_member_) return damaged("truncated: the file ends inside it");
    return std::size_t{0};
  }
  Result<std::size_t> damaged(std::string_view what) {
    return fail(Errc::kInvalidInput, fmt::format("{}: {} data before byte {} is {}", file_.path(),
                                                 Codec::kName, file_.offset() - codec_.pending(), what));
  }

  RawFile file_;
  Codec codec_;
  std::array<char, 65536> in_{};
  bool in_member_ = true;
};

Result<RawFile> open_raw(const std::string& path) {
  File file(std::fopen(path.c_str(), "rbe"));
  if (file == nullptr) {
    const Errc code = errno == ENOENT ? Errc::kNotFound : errno == EACCES ? Errc::kPermission : Errc::kIo;
    return fail(code, fmt::format("{}: cannot open: {}", path, std::strerror(errno)), errno);
  }
  struct stat info {};
  if (fstat(fileno(file.get()), &info) == 0 && S_ISDIR(info.st_mode)) {
    return fail(Errc::kInvalidInput, fmt::format("{}: found a directory, expected a file", path));
  }
  return RawFile(path, std::move(file));
}

}  // namespace

Result<std::unique_ptr<ByteSource>> open_source(const std::string& path) {
  auto file = open_raw(path);
  if (!file.has_value()) return tl::unexpected(file.error());
  std::array<char, 3> magic{};
  const auto n = file->read(magic);
  if (!n.has_value()) return tl::unexpected(n.error());
  file->rewind();
  const std::string_view head(magic.data(), *n);
  if (head == "BZh") return std::make_unique<PackedSource<Bzip2>>(std::move(*file));
  if (head.starts_with("\x1f\x8b")) return std::make_unique<PackedSource<Gzip>>(std::move(*file));
  for (const auto& [ending, name] : {std::pair{".bz2", Bzip2::kName}, std::pair{".gz", Gzip::kName}}) {
    if (path.ends_with(ending)) {
      return fail(Errc::kInvalidInput,
                  fmt::format("{}: expected {} data as the name says, found other content", path, name));
    }
  }
  return std::make_unique<PlainSource>(std::move(*file));
}

}  // namespace topo::bench
