// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/area_control.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <optional>
#include <utility>

#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/input_file.hpp"

namespace topo::daemon {
namespace {

constexpr std::size_t kLargestFile = 1 << 20;

std::string path_in(const std::string& folder) { return folder.empty() ? folder : folder + "/areas.json"; }

types::Result<AreaBook> load(const std::string& file) {
  const auto text = read_file(file, kLargestFile);
  if (!text) return tl::unexpected(text.error());
  return AreaBook::parse(*text);
}

}  // namespace

AreaControl::AreaControl(const types::AreaLimits& configured, HandOvers& hand_overs, Background& files,
                         const std::string& folder, Announce announce)
    : configured_(configured),
      hand_overs_(hand_overs),
      files_(files),
      file_(path_in(folder)),
      announce_(std::move(announce)) {}

void AreaControl::start() {
  if (!file_.empty() && ::access(file_.c_str(), F_OK) == 0) {
    auto loaded = load(file_);
    if (!loaded) {
      unread_ = fmt::format(
          "the drawn areas cannot be read: {}: {}; repair the file or remove it, start again, and draw "
          "them again",
          file_, loaded.error().message);
      spdlog::error("{}", unread_);
    } else {
      book_ = std::move(*loaded);
    }
  }
  if (!book_.areas().empty()) spdlog::info("{} drawn areas are in force", book_.areas().size());
  enforce();
  if (!book_.areas().empty())
    announce_({{"event", "area"}, {"what", "kept from before"}, {"areas", book_.json()["areas"]}});
}

void AreaControl::enforce() {
  const types::AreaLimits limits = in_force();
  hand_overs_.place.limited.store(!limits.empty(), std::memory_order_release);
  hand_overs_.area.store(limits);
  hand_overs_.to_planning.area.store(limits);
  hand_overs_.to_planning.here_first.store(book_.here_first());
  hand_overs_.to_planning.wakeup.post();
  hand_overs_.team.areas.store(book_.wishes());
  hand_overs_.team.wakeup.post();
}

types::Result<std::string> AreaControl::draw(const types::Polygon& corners_map, types::AreaKind kind) {
  if (!unread_.empty()) return types::fail(types::Errc::kBusy, unread_);
  auto id = book_.draw(corners_map, kind);
  if (!id) return id;
  enforce();
  keep();
  tell("drawn", book_.areas().back());
  return id;
}

types::Status AreaControl::withdraw(const std::string& id) {
  const auto found = std::ranges::find(book_.areas(), id, &id_of);
  const std::optional<DrawnArea> area = found == book_.areas().end() ? std::nullopt : std::optional(*found);
  if (auto done = book_.withdraw(id); !done) return done;
  enforce();
  keep();
  if (area) tell("withdrawn", *area);
  return {};
}

bool AreaControl::knows_place() const { return hand_overs_.place.now() == types::PlaceStanding::kKnown; }

void AreaControl::note(const TeamAreas& team) {
  if (!knows_place()) anchors_ = {};  // another map is no correction of this one
  const std::string before = book_.trouble();
  const std::size_t count = book_.areas().size();
  const bool changed = book_.note(team);
  if (book_.trouble() != before && !book_.trouble().empty()) spdlog::warn("{}", book_.trouble());
  if (!changed) return;
  enforce();
  keep();
  if (book_.areas().size() != count)
    announce_({{"event", "area"}, {"what", "by the team"}, {"areas", book_.json()["areas"]}});
}

void AreaControl::note_map(std::span<const types::KeyframePose> keyframes) {
  constexpr AreaMoveParams kParams;
  if (!knows_place()) return;
  const auto correction = anchors_.take(keyframes, kParams.by_m, kParams.by_rad);
  if (!correction || !book_.move(*correction)) return;
  enforce();
  keep();
  announce_({{"event", "area"}, {"what", "moved with the map"}, {"areas", book_.json()["areas"]}});
}

/// With all that are in force then: who reads the log needs no other line.
void AreaControl::tell(const char* what, const DrawnArea& area) {
  spdlog::info("area {}, {}: {}", id_of(area), types::to_text(area.kind), what);
  announce_({{"event", "area"},
             {"what", what},
             {"id", id_of(area)},
             {"area_kind", types::to_text(area.kind)},
             {"corners_m", corners_json(area.corners_map)},
             {"areas", book_.json()["areas"]}});
}

/// The disk may be slow; of several writes the last one counts.
void AreaControl::keep() {
  if (file_.empty() || !unread_.empty()) return;
  auto job = [this, number = ++writes_, text = book_.text(), file = file_]() -> Background::Finish {
    return [this, number, done = write_file(file, std::string_view(text))] {
      written_ = number;
      const std::string before = std::exchange(unwritten_, done ? std::string() : done.error().message);
      if (!unwritten_.empty() && unwritten_ != before) spdlog::error("areas: {}", unwritten_);
    };
  };
  if (const auto added = files_.add(std::move(job)); !added) unwritten_ = added.error().message;
}

std::string AreaControl::trouble() const {
  if (!unread_.empty()) return unread_;
  if (!unwritten_.empty()) return fmt::format("in force, but NOT kept over a restart: {}", unwritten_);
  return book_.trouble();
}

Json AreaControl::json() const {
  Json json = book_.json();
  json["kept"] = !file_.empty() && unread_.empty() && unwritten_.empty() && written_ == writes_;
  json["trouble"] = trouble();
  return json;
}

}  // namespace topo::daemon
