// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/types/result.hpp"

namespace topo::daemon {

/// What a QR code looks like in a terminal.
struct QrLook {
  int margin = 2;       ///< light modules around it; readers of telephones want at least so many
  bool colours = true;  ///< escape sequences for black on white, whatever the terminal's colours are
};

/// A QR code (ISO/IEC 18004) of the text, two modules above each other a character, in lines. kInvalidInput
/// for an empty text and for one that is too long.
types::Result<std::string> qr_text(std::string_view text, const QrLook& look = {});

}  // namespace topo::daemon
