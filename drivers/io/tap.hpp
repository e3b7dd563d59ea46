// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "drivers/io/byte_stream.hpp"

namespace topo::io {

enum class Direction { kFromDevice, kToDevice };

/// Receives every byte of one device, in order: raw recording. Called on the thread that uses the stream,
/// within read() and write(): it must neither block nor allocate while streaming.
class ByteTap {
 public:
  virtual ~ByteTap() = default;
  virtual void on_open(Stamp stamp) noexcept = 0;
  /// `stamp`: the read's own stamp, or the time at which the write completed. A failed write is not reported.
  virtual void on_bytes(Direction direction, Stamp stamp, std::span<const std::byte> bytes) noexcept = 0;
  virtual void on_close(Stamp stamp) noexcept = 0;
};

/// A connector whose streams report to a tap; otherwise equal to the inner connector. `tap` must outlive it
/// and its streams.
class TappedConnector final : public Connector {
 public:
  TappedConnector(std::unique_ptr<Connector> inner, ByteTap* tap) : inner_(std::move(inner)), tap_(tap) {}

  Result<std::unique_ptr<ByteStream>> connect(Duration timeout) override;
  [[nodiscard]] std::string_view name() const override { return inner_->name(); }
  [[nodiscard]] Stamp now() const override { return inner_->now(); }
  void pause(Duration duration) override { inner_->pause(duration); }

 private:
  std::unique_ptr<Connector> inner_;
  ByteTap* tap_;
};

}  // namespace topo::io
