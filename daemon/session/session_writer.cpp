// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/session_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/slam/keyframe_codec.hpp"
#include "core/types/bytes.hpp"
#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/session/format.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::Result;
using types::Status;

// Small records: damage costs the record that it hits, and zstd saves only 1 % more on larger ones.
constexpr std::size_t kRecordTarget = 16U * 1024U;  ///< a record of keyframes is closed when it reaches this
constexpr std::size_t kPosesEach = 512;
constexpr std::size_t kEdgesEach = 128;

void put(types::ByteWriter& out, const types::Se2& pose) {
  out.real(pose.x_m);
  out.real(pose.y_m);
  out.real(pose.theta_rad);
}

void put(types::ByteWriter& out, const slam::Edge& edge) {
  out.varint(edge.from);
  out.varint(edge.to);
  out.integer(static_cast<std::uint8_t>(edge.robust ? 1 : 0));
  put(out, edge.T_from_to);
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) out.real(edge.information(row, column));
  }
  out.integer(edge.finder.robot);
  out.integer(edge.finder.run);
  out.integer(edge.finder.sequence);
}

bool same(const slam::Edge& a, const slam::Edge& b) {
  return a.from == b.from && a.to == b.to && a.robust == b.robust && a.T_from_to == b.T_from_to &&
         a.information == b.information && a.finder == b.finder;
}

/// Records and the number of the next one.
struct Output {
  std::vector<std::byte> bytes;
  std::uint32_t number = 0;

  [[nodiscard]] bool append(SessionRecord kind, std::size_t first, std::span<const std::byte> content) {
    return append_record(bytes, kind, number++, static_cast<std::uint32_t>(first), content);
  }
};

/// Appends items from number `first` on, at most `each` per record; one record without items when the list
/// was only shortened.
template <class Item>
void append_from(Output& out, SessionRecord kind, const std::vector<Item>& items, std::size_t first,
                 std::size_t each) {
  do {
    types::ByteWriter content;
    const std::size_t begin = first, last = std::min(items.size(), first + each);
    for (; first < last; ++first) put(content, items[first]);
    static_cast<void>(out.append(kind, begin, content.bytes()));  // bounded by `each`
  } while (first < items.size());
}

Status append_keyframes(Output& out, const std::vector<slam::KeyframePtr>& keyframes, std::size_t first) {
  types::ByteWriter content;
  for (std::size_t i = first; i < keyframes.size(); ++i) {
    const auto bytes = slam::encode_keyframe(*keyframes[i]);
    content.varint(bytes.size());
    content.append(bytes);
    if (content.bytes().size() < kRecordTarget && i + 1 < keyframes.size()) continue;
    if (!out.append(SessionRecord::kKeyframes, first, content.bytes())) {
      return types::fail(Errc::kInvalidInput,
                         fmt::format("keyframe {}: found {} bytes, expected at most {}", i, bytes.size(),
                                     kSessionRecordBytesMax - kRecordTarget));
    }
    content = {};
    first = i + 1;
  }
  return {};
}

}  // namespace

std::size_t SessionWriter::first_moved(const slam::Session& session, const PoseTolerance& tolerance) const {
  const std::size_t known = std::min(poses_.size(), session.poses.size());
  for (std::size_t i = 0; i < known; ++i) {
    if (poses_[i] == session.poses[i]) continue;
    if (types::is_apart(poses_[i], session.poses[i], tolerance.trans_m, tolerance.rot_rad) ||
        (tolerance.trans_m == 0.0 && tolerance.rot_rad == 0.0)) {
      return i;
    }
  }
  return known;
}

std::size_t SessionWriter::first_other_edge(const slam::Session& session) const {
  const std::size_t known = std::min(edges_.size(), session.edges.size());
  const auto other = std::mismatch(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(known),
                                   session.edges.begin(), same);
  return static_cast<std::size_t>(other.first - edges_.begin());
}

Result<std::vector<std::byte>> SessionWriter::changes(const slam::Session& session,
                                                      const PoseTolerance& tolerance) {
  Output out{{}, records_};
  if (auto s = append_keyframes(out, session.keyframes, keyframes_); !s) return tl::unexpected(s.error());
  const std::size_t edge = first_other_edge(session), pose = first_moved(session, tolerance);
  if (edge < edges_.size() || edge < session.edges.size())
    append_from(out, SessionRecord::kEdges, session.edges, edge, kEdgesEach);
  // Last: when the file is truncated here, keyframes without a pose are left out.
  if (pose < session.poses.size()) append_from(out, SessionRecord::kPoses, session.poses, pose, kPosesEach);
  pending_ = out.number - records_;
  return std::move(out.bytes);
}

void SessionWriter::written(const slam::Session& session, const PoseTolerance& tolerance) {
  const std::size_t pose = first_moved(session, tolerance);
  poses_.resize(pose);
  poses_.insert(poses_.end(), session.poses.begin() + static_cast<std::ptrdiff_t>(pose), session.poses.end());
  edges_ = session.edges;
  keyframes_ = session.keyframes.size();
  records_ += pending_;
  pending_ = 0;
}

std::vector<std::byte> SessionWriter::end() const {
  types::ByteWriter content;
  content.varint(keyframes_);
  content.varint(edges_.size());
  content.varint(poses_.size());
  std::vector<std::byte> out;
  static_cast<void>(append_record(out, SessionRecord::kEnd, records_, 0, content.bytes()));  // a few bytes
  return out;
}

Result<std::vector<std::byte>> session_bytes(const slam::Session& session, std::uint64_t params_hash) {
  SessionWriter writer;
  auto records = writer.changes(session, {});
  if (!records) return records;
  writer.written(session, {});
  std::vector<std::byte> bytes = encode_session_header({params_hash});
  const std::vector<std::byte> end = writer.end();
  bytes.insert(bytes.end(), records->begin(), records->end());
  bytes.insert(bytes.end(), end.begin(), end.end());
  return bytes;
}

Status save_session(const std::string& path, const slam::Session& session, std::uint64_t params_hash) {
  const auto bytes = session_bytes(session, params_hash);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_file(path, *bytes);
}

}  // namespace topo::daemon
