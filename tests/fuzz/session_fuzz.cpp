// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Session and journal files of any content: refused with a reason, or a sound session that, written anew, is
// read the same. A fuzzer finds no checksum by itself: the input is read twice, as a file, and with every
// "TSRC" in it sealed as a record, so that what the records say is reached too.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/slam/session.hpp"
#include "core/types/bytes.hpp"
#include "daemon/recording/format.hpp"
#include "daemon/session/session_reader.hpp"
#include "daemon/session/session_writer.hpp"

namespace {

using topo::daemon::parse_session;
using topo::daemon::SessionRecordHead;

void require(bool holds) {
  if (!holds) std::abort();
}

void check(std::span<const std::byte> file) {
  const auto loaded = parse_session(file);
  if (!loaded) {
    require(!loaded.error().message.empty());
    return;
  }
  require(topo::slam::check_session(loaded->session).has_value());
  require(loaded->bytes + loaded->damaged == file.size());
  require(loaded->closed || !damage_text(*loaded).empty());
  std::size_t end = 0;
  for (const auto& piece : loaded->pieces) {
    require(piece.bytes > 0 && piece.offset >= end && piece.offset + piece.bytes <= file.size());
    end = piece.offset + piece.bytes;
  }
  const auto bytes = topo::daemon::session_bytes(loaded->session, loaded->params_hash);
  require(bytes.has_value());
  const auto again = parse_session(*bytes);
  require(again.has_value() && again->closed && again->damaged == 0);
  require(again->session.keyframes.size() == loaded->session.keyframes.size() &&
          again->session.poses == loaded->session.poses &&
          again->session.edges.size() == loaded->session.edges.size());
}

/// Gives each record head its checksums, for as many packed bytes as it says and there are.
std::vector<std::byte> sealed(std::span<const std::byte> file) {
  constexpr std::size_t kHead = SessionRecordHead::kSize;
  std::vector<std::byte> out(file.begin(), file.end());
  for (std::size_t at = topo::daemon::find_record_magic(out, 0); at + kHead <= out.size();) {
    const std::span<std::byte> rest = std::span(out).subspan(at);
    const auto says = topo::types::load_le<std::uint32_t>(rest, 16);
    const auto packed = static_cast<std::uint32_t>(std::min<std::size_t>(says, rest.size() - kHead));
    topo::types::store_le(rest, 16, packed);
    topo::types::store_le(rest, 24, topo::daemon::checksum(rest.subspan(kHead, packed)));
    topo::types::store_le(rest, 32, topo::daemon::checksum(rest.first(32)));
    at = topo::daemon::find_record_magic(out, at + kHead + packed);
  }
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  check(bytes);
  check(sealed(bytes));
  return 0;
}
