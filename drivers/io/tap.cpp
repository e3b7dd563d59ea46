// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/tap.hpp"

#include <algorithm>
#include <utility>

namespace topo::io {
namespace {

class TappedStream final : public ByteStream {
 public:
  TappedStream(std::unique_ptr<ByteStream> inner, ByteTap* tap) : inner_(std::move(inner)), tap_(tap) {
    tap_->on_open(inner_->now());
  }
  ~TappedStream() override { tap_->on_close(inner_->now()); }
  TappedStream(const TappedStream&) = delete;
  TappedStream& operator=(const TappedStream&) = delete;

  Result<ReadResult> read(std::span<std::byte> buffer, Duration timeout) override {
    auto result = inner_->read(buffer, timeout);
    if (result && result->bytes > 0) {
      tap_->on_bytes(Direction::kFromDevice, result->stamp,
                     buffer.first(std::min(result->bytes, buffer.size())));
    }
    return result;
  }

  Status write(std::span<const std::byte> bytes, Duration timeout) override {
    auto result = inner_->write(bytes, timeout);
    if (result) tap_->on_bytes(Direction::kToDevice, inner_->now(), bytes);
    return result;
  }

  [[nodiscard]] bool ready() const override { return inner_->ready(); }
  [[nodiscard]] BusFaults faults() const override { return inner_->faults(); }
  Status set_baud(int baud) override { return inner_->set_baud(baud); }
  [[nodiscard]] bool has_baud() const override { return inner_->has_baud(); }
  [[nodiscard]] Stamp now() const override { return inner_->now(); }

 private:
  std::unique_ptr<ByteStream> inner_;
  ByteTap* tap_;
};

}  // namespace

Result<std::unique_ptr<ByteStream>> TappedConnector::connect(Duration timeout) {
  auto stream = inner_->connect(timeout);
  if (!stream) return stream;
  return std::make_unique<TappedStream>(std::move(*stream), tap_);
}

}  // namespace topo::io
