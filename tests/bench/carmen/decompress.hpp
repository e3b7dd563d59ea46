// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/types/result.hpp"

namespace topo::bench {

/// A file's content as one stream of bytes, decompressed while reading. Used by one thread.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Fills the beginning of the buffer; returns 0 only at the end of the content. Errors name the file:
  /// kInvalidInput when the compressed data are damaged or truncated, kIo when the file cannot be read.
  virtual types::Result<std::size_t> read(std::span<char> buffer) = 0;
};

/// Opens plain, gzip (RFC 1952) and bzip2 files, also with several members in sequence. The first bytes
/// determine the format; a name ending in .gz or .bz2 with other content is kInvalidInput.
types::Result<std::unique_ptr<ByteSource>> open_source(const std::string& path);

}  // namespace topo::bench
