// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/session_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/slam/keyframe_codec.hpp"
#include "core/types/bytes.hpp"
#include "daemon/mapfile/input_file.hpp"
#include "daemon/session/format.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::Result;
using types::Status;

constexpr std::size_t kMaxFileBytes = 1U << 30U;
constexpr std::size_t kPoseBytes = 24;
constexpr std::size_t kEdgeBytes = 2 + 1 + 9 * 8;  ///< minimum size

types::Se2 read_pose(types::ByteReader& in) {
  types::Se2 pose;
  pose.x_m = in.real64();
  pose.y_m = in.real64();
  pose.theta_rad = in.real64();
  return pose;
}

slam::Edge read_edge(types::ByteReader& in) {
  slam::Edge edge;
  edge.from = static_cast<std::size_t>(in.varint());
  edge.to = static_cast<std::size_t>(in.varint());
  edge.robust = in.integer<std::uint8_t>() != 0;
  edge.T_from_to = read_pose(in);
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column)
      edge.information(row, column) = edge.information(column, row) = in.real64();
  }
  return edge;
}

/// Reads items from the number given first; false when that leaves a gap, or bytes remain.
template <class Item, class Read>
bool replace_from(types::ByteReader& in, std::vector<Item>& items, std::size_t bytes_each, Read read) {
  const std::uint64_t first = in.varint();
  if (!in.ok() || first > items.size()) return false;
  items.resize(static_cast<std::size_t>(first));
  while (in.ok() && in.remaining() >= bytes_each) items.push_back(read(in));
  return in.complete();
}

bool read_keyframes(std::span<const std::byte> rest, std::vector<slam::KeyframePtr>& keyframes) {
  while (!rest.empty()) {
    types::ByteReader in(rest);
    const std::size_t size = in.count(1);
    if (!in.ok() || size > in.remaining()) return false;
    rest = rest.last(in.remaining());
    auto keyframe = slam::decode_keyframe(rest.first(size));
    if (!keyframe) return false;
    keyframes.push_back(std::make_shared<const slam::Keyframe>(std::move(*keyframe)));
    rest = rest.subspan(size);
  }
  return true;
}

/// Applies a record; false when its content is invalid for its kind.
bool take(const ReadRecord& record, LoadedSession& loaded) {
  slam::Session& session = loaded.session;
  types::ByteReader in(record.content);
  switch (record.kind) {
    case SessionRecord::kKeyframes:
      return read_keyframes(record.content, session.keyframes);
    case SessionRecord::kEdges:
      return replace_from(in, session.edges, kEdgeBytes, &read_edge);
    case SessionRecord::kPoses:
      return replace_from(in, session.poses, kPoseBytes, &read_pose);
    case SessionRecord::kEnd:
      loaded.closed = in.varint() == session.keyframes.size() && in.varint() == session.edges.size() &&
                      in.varint() == session.poses.size() && in.complete();
      return loaded.closed;
  }
  return false;
}

/// Removes keyframes without a written pose, and the edges that refer to them.
void trim(slam::Session& session) {
  const std::size_t n = std::min(session.keyframes.size(), session.poses.size());
  session.keyframes.resize(n);
  session.poses.resize(n);
  std::erase_if(session.edges, [n](const slam::Edge& e) { return e.from >= n || e.to >= n; });
}

std::string foreign_text(std::uint32_t version) {
  return version != 0 && version != kSessionVersion
             ? fmt::format("found version {}, expected {}", version, kSessionVersion)
             : std::string("the file does not begin as a session does");
}

}  // namespace

Result<LoadedSession> parse_session(std::span<const std::byte> file) {
  std::uint32_t version = 0;
  const auto header = decode_session_header(file, version);
  if (!header) return types::fail(Errc::kInvalidInput, foreign_text(version));
  LoadedSession loaded;
  loaded.params_hash = header->params_hash;
  loaded.bytes = SessionHeader::kSize;
  while (!loaded.closed) {
    const auto record = read_record(file.subspan(loaded.bytes));
    if (!record || !take(*record, loaded)) break;
    loaded.bytes += record->bytes;
  }
  loaded.damaged = file.size() - loaded.bytes;
  loaded.cut = is_cut(file.subspan(loaded.bytes));
  trim(loaded.session);
  if (const Status sound = slam::check_session(loaded.session); !sound) return tl::unexpected(sound.error());
  return loaded;
}

std::string damage_text(const LoadedSession& loaded) {
  const std::size_t size = loaded.bytes + loaded.damaged;
  if (loaded.closed && loaded.damaged == 0) return {};
  if (loaded.closed) return fmt::format("{} bytes behind its end are no part of it", loaded.damaged);
  if (loaded.damaged == 0) return fmt::format("it ends at byte {} and was not closed", size);
  if (loaded.cut) return fmt::format("cut at byte {}, its last whole record ends at {}", size, loaded.bytes);
  return fmt::format("damaged at byte {} of {}", loaded.bytes, size);
}

Result<LoadedSession> load_session(const std::string& path) {
  const auto content = read_file(path, kMaxFileBytes);
  if (!content) return tl::unexpected(content.error());
  auto loaded = parse_session(std::as_bytes(std::span(*content)));
  if (!loaded) return types::fail(loaded.error().code, fmt::format("{}: {}", path, loaded.error().message));
  return loaded;
}

Status check_map(const LoadedSession& loaded, const std::string& path) {
  if (!loaded.session.keyframes.empty()) return {};
  const std::string damage = damage_text(loaded);
  return types::fail(Errc::kInvalidInput, fmt::format("{}: no keyframe with a pose is in it{}{}", path,
                                                      damage.empty() ? "" : ": ", damage));
}

std::string header_fault(const std::string& path) {
  const auto beginning = read_beginning(path, SessionHeader::kSize);
  if (!beginning) return beginning.error().message;
  std::uint32_t version = 0;
  if (decode_session_header(std::as_bytes(std::span(*beginning)), version)) return {};
  return foreign_text(version);
}

}  // namespace topo::daemon
