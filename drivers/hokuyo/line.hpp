// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "drivers/hokuyo/scip_parser.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::hokuyo {

/// An open stream with its parser: requests out, replies and scans in. One thread; allocates nothing while
/// open, unless a call fails.
class Line {
 public:
  void open(std::unique_ptr<io::ByteStream> stream);
  void close() { stream_.reset(); }
  [[nodiscard]] bool is_open() const { return stream_ != nullptr; }
  [[nodiscard]] io::ByteStream& stream() { return *stream_; }

  /// Writes the request and its line feed.
  types::Status send(std::string_view request);
  /// The next event, or kNone when none was complete by `until`.
  types::Result<ScipParser::Event> poll(types::Stamp until);

  [[nodiscard]] const Reply& reply() const { return parser_.reply(); }
  [[nodiscard]] const RawScan& scan() const { return parser_.scan(); }
  /// Arrival of the last byte of the event that poll() returned.
  [[nodiscard]] types::Stamp arrival() const { return arrival_; }
  [[nodiscard]] types::Stamp now() const { return stream_->now(); }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  /// The first bytes since open(), for a message about a device that uses another protocol.
  [[nodiscard]] bool heard_anything() const { return sample_size_ > 0; }
  [[nodiscard]] bool heard_arcos() const;
  [[nodiscard]] std::string heard_text() const;

 private:
  void note_sample(std::span<const std::byte> bytes);

  std::unique_ptr<io::ByteStream> stream_;
  ScipParser parser_;
  std::array<std::byte, 8192> buffer_{};
  std::size_t begin_ = 0, end_ = 0;
  types::Stamp arrival_{};
  std::uint64_t bytes_ = 0;
  std::array<std::byte, 64> sample_{};
  std::size_t sample_size_ = 0;
};

}  // namespace topo::hokuyo
