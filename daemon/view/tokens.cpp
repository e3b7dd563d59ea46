// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/tokens.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/sha.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/input_file.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

constexpr std::string_view kLetters = "abcdefghjkmnpqrstuvwxyz23456789";  // 31 to the 20th is 2 to the 99th
constexpr std::size_t kLength = 20, kGroup = 4;
constexpr std::size_t kHashDigits = 2 * SHA256_DIGEST_LENGTH;
constexpr std::size_t kNameMax = 32;
constexpr std::size_t kMaxFileBytes = 65'536;  ///< some 600 tokens

bool is_hash(std::string_view text) {
  return text.size() == kHashDigits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// The part of `line` before the next blank, which goes from it.
std::string take_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  std::string word(line.substr(0, end));
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

}  // namespace

std::string tokens_path(const std::string& folder) { return folder + "/tokens"; }

Result<std::string> make_token() {
  std::string token;
  std::size_t letters = 0;
  while (letters < kLength) {
    unsigned char byte = 0;
    if (::getrandom(&byte, sizeof byte, 0) != sizeof byte)
      return fail(Errc::kIo, fmt::format("no random bytes: {}", std::strerror(errno)), errno);
    constexpr std::size_t kEven =
        256 / kLetters.size() * kLetters.size();  // beyond it the first letters came oftener
    if (byte >= kEven) continue;
    if (letters > 0 && letters % kGroup == 0) token += '-';
    token += kLetters[byte % kLetters.size()];
    ++letters;
  }
  return token;
}

std::string token_hash(std::string_view token) {
  std::string plain;
  for (const char c : token) {
    if (c >= 'A' && c <= 'Z') plain += static_cast<char>(c - 'A' + 'a');
    if (c != '-' && c != ' ' && (c < 'A' || c > 'Z')) plain += c;
  }
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  ::SHA256(reinterpret_cast<const unsigned char*>(plain.data()), plain.size(), digest.data());
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::string tokens_text(const std::vector<KeptToken>& tokens) {
  std::string text;
  for (const KeptToken& token : tokens)
    text += fmt::format("{} {} {}\n", token.sha256, token.made, token.name);
  return text;
}

Result<std::vector<KeptToken>> parse_tokens(std::string_view text) {
  std::vector<KeptToken> tokens;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    KeptToken token;
    token.sha256 = take_word(line);
    token.made = take_word(line);
    token.name = take_word(line);
    if (!is_hash(token.sha256) || token.made.empty() || !is_token_name(token.name) || !line.empty()) {
      return fail(Errc::kInvalidInput,
                  fmt::format("line {}: expected a SHA-256 in hexadecimal digits, a date and a name",
                              tokens.size() + 1));
    }
    tokens.push_back(std::move(token));
  }
  return tokens;
}

Result<std::vector<KeptToken>> load_tokens(const std::string& folder) {
  const std::string path = tokens_path(folder);
  if (::access(path.c_str(), F_OK) != 0 && errno == ENOENT) return std::vector<KeptToken>{};
  const auto text = read_file(path, kMaxFileBytes);
  if (!text) return tl::unexpected(text.error());
  auto tokens = parse_tokens(*text);
  if (!tokens) return fail(tokens.error().code, fmt::format("{}: {}", path, tokens.error().message));
  return tokens;
}

Status save_tokens(const std::string& folder, const std::vector<KeptToken>& tokens) {
  constexpr mode_t kFolderMode = 0700;
  if (::mkdir(folder.c_str(), kFolderMode) != 0 && errno != EEXIST)
    return fail(Errc::kIo, fmt::format("{}: cannot make the folder: {}", folder, std::strerror(errno)),
                errno);
  return write_file(tokens_path(folder), tokens_text(tokens));
}

bool is_known_hash(const std::vector<KeptToken>& tokens, std::string_view hash) {
  bool known = false;
  for (const KeptToken& token : tokens) {
    known |= token.sha256.size() == hash.size() &&
             ::CRYPTO_memcmp(token.sha256.data(), hash.data(), hash.size()) == 0;
  }
  return known;
}

bool is_token_name(std::string_view name) {
  return !name.empty() && name.size() <= kNameMax && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

}  // namespace topo::daemon
