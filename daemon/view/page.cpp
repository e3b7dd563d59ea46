// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/page.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>

#include "core/types/invariant.hpp"

namespace topo::daemon {

const PageFile* find_page_file(std::string_view target) {
  target = target.substr(0, target.find('?'));
  if (target == "/") target = "/index.html";
  const auto files = page_files();
  const auto found = std::ranges::find_if(files, [target](const PageFile& file) {
    return target.size() == file.name.size() + 1 && target.front() == '/' && target.substr(1) == file.name;
  });
  return found == files.end() ? nullptr : &*found;
}

std::string_view media_type(std::string_view name) {
  struct Type {
    std::string_view ending, type;
  };
  constexpr std::array<Type, 4> kTypes{{{".html", "text/html; charset=utf-8"},
                                        {".js", "text/javascript; charset=utf-8"},
                                        {".css", "text/css; charset=utf-8"},
                                        {".svg", "image/svg+xml"}}};
  const auto found = std::ranges::find_if(kTypes, [name](const Type& t) { return name.ends_with(t.ending); });
  return found == kTypes.end() ? "application/octet-stream" : found->type;
}

std::string gzip(std::string_view bytes) {
  constexpr int kGzipWindow = 15 + 16;  // zlib.h: 16 more make the header of gzip
  constexpr int kMemory = 8;
  z_stream stream{};
  types::require(::deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemory,
                                Z_DEFAULT_STRATEGY) == Z_OK,
                 "zlib has no memory");
  std::string packed(::deflateBound(&stream, bytes.size()), '\0');
  std::string text(bytes);  // zlib reads it only, and asks for more
  stream.next_in = reinterpret_cast<Bytef*>(text.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  types::require(::deflate(&stream, Z_FINISH) == Z_STREAM_END, "zlib's bound was too small");
  packed.resize(stream.total_out);
  ::deflateEnd(&stream);
  return packed;
}

}  // namespace topo::daemon
