// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/qr_text.hpp"

#include <fmt/format.h>
#include <qrencode.h>

#include <memory>

namespace topo::daemon {

types::Result<std::string> qr_text(std::string_view text, const QrLook& look) {
  using types::Errc;
  const std::string whole(text);  // the library wants its end
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
      QRcode_encodeString(whole.c_str(), 0, QR_ECLEVEL_M, QR_MODE_8, 1), &QRcode_free);
  if (code == nullptr)
    return types::fail(Errc::kInvalidInput,
                       fmt::format("found {} bytes, expected what a QR code holds", text.size()));
  const int side = code->width;
  const auto is_dark = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < side && y < side;
    return inside && (code->data[y * side + x] & 1U) != 0;
  };
  // A block is ink: dark.
  constexpr std::string_view kBlocks[2][2] = {{" ", "▄"}, {"▀", "█"}};
  std::string lines;
  for (int y = -look.margin; y < side + look.margin; y += 2) {
    if (look.colours) lines += "\033[30;47m";
    for (int x = -look.margin; x < side + look.margin; ++x)
      lines += kBlocks[is_dark(x, y)][is_dark(x, y + 1)];
    lines += look.colours ? "\033[0m\n" : "\n";
  }
  return lines;
}

}  // namespace topo::daemon
