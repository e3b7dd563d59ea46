// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/token_commands.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>

#include "daemon/view/qr_text.hpp"
#include "daemon/view/tokens.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Status;

/// The name by which another machine most likely reaches this one.
std::string shown_host(const ViewConfig& view) {
  if (view.address != "0.0.0.0" && view.address != "::") return view.address;
  if (!view.hosts.empty()) return view.hosts.front();
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "ROBOT";
  return name.data();
}

}  // namespace

Status pair_browser(const ViewConfig& view, const std::string& name) {
  if (!is_token_name(name)) {
    return fail(Errc::kInvalidInput,
                fmt::format("--name: found \"{}\", expected 1 to 32 letters, digits, - and _", name));
  }
  auto tokens = load_tokens(view.state_folder);
  if (!tokens) return tl::unexpected(tokens.error());
  if (std::ranges::count(*tokens, name, &KeptToken::name) > 0) {
    return fail(Errc::kInvalidInput,
                fmt::format("there is a token called {}: topoview revoke {}, or another --name", name, name));
  }
  const auto token = make_token();
  if (!token) return tl::unexpected(token.error());
  const std::string now = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  tokens->push_back({name, now, token_hash(*token)});
  if (auto saved = save_tokens(view.state_folder, *tokens); !saved) return saved;
  const std::string host = shown_host(view);
  const bool v6 = host.find(':') != std::string::npos;
  // Behind the # of an address, which a browser does not send.
  const std::string address =
      fmt::format("http://{}{}{}:{}/#token={}", v6 ? "[" : "", host, v6 ? "]" : "", view.port, *token);
  fmt::print("token    {}\naddress  {}\n\n", *token, address);
  if (const auto code = qr_text(address, {.margin = 2, .colours = ::isatty(STDOUT_FILENO) == 1}))
    fmt::print("{}\n", *code);
  fmt::print("It is shown this once. topoview revoke {} ends it.\n", name);
  return {};
}

Status list_tokens(const ViewConfig& view) {
  const auto tokens = load_tokens(view.state_folder);
  if (!tokens) return tl::unexpected(tokens.error());
  if (tokens->empty()) fmt::print("no tokens: topoview pair makes one\n");
  for (const KeptToken& token : *tokens) fmt::print("{:<32}  {}\n", token.name, token.made);
  return {};
}

Status revoke_token(const ViewConfig& view, const std::string& name) {
  auto tokens = load_tokens(view.state_folder);
  if (!tokens) return tl::unexpected(tokens.error());
  if (std::erase_if(*tokens, [&](const KeptToken& token) { return token.name == name; }) == 0)
    return fail(Errc::kNotFound, fmt::format("there is no token called \"{}\": see topoview tokens", name));
  return save_tokens(view.state_folder, *tokens);
}

}  // namespace topo::daemon
