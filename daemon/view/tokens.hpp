// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

/// A token as it is kept: whoever reads the file cannot act with it.
struct KeptToken {
  std::string name;    ///< 1 to 32 letters, digits, - and _
  std::string made;    ///< UTC, ISO 8601
  std::string sha256;  ///< of the token, in hexadecimal digits
  friend bool operator==(const KeptToken&, const KeptToken&) = default;
};

/// A new token: 20 letters and digits in groups of four, 99 random bits, without those that are read for one
/// another. So many need no slow hash: nobody tries them all. kIo when the kernel gives no random bytes.
types::Result<std::string> make_token();

/// SHA-256 of a token, without its hyphens and in small letters: as it was read out or typed.
std::string token_hash(std::string_view token);

/// The file's content, a line for each token, and back. kInvalidInput names the line.
std::string tokens_text(const std::vector<KeptToken>& tokens);
types::Result<std::vector<KeptToken>> parse_tokens(std::string_view text);

/// The file in view.state_folder.
std::string tokens_path(const std::string& folder);
/// The tokens in the folder's file; empty when there is none. Errors name the file.
types::Result<std::vector<KeptToken>> load_tokens(const std::string& folder);
/// Replaces the file; makes the folder, open to its owner alone, but not its parents.
types::Status save_tokens(const std::string& folder, const std::vector<KeptToken>& tokens);

/// True when one of the tokens has this hash. Takes as long for one that is nearly right.
bool is_known_hash(const std::vector<KeptToken>& tokens, std::string_view hash);

bool is_token_name(std::string_view name);

}  // namespace topo::daemon
