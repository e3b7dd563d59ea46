// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/area_book.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "daemon/config/polygon.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Polygon;
using types::Result;
using types::Status;

constexpr int kVersion1 = 1;

Result<Polygon> read_corners(const Json& json) {
  Polygon corners;
  if (!json.is_array()) return fail(Errc::kInvalidInput, "an area without a list of corners");
  for (const Json& corner : json) {
    if (!corner.is_array() || corner.size() != 2 || !corner[0].is_number() || !corner[1].is_number())
      return fail(Errc::kInvalidInput, "a corner is no pair of numbers");
    corners.emplace_back(corner[0].get<double>(), corner[1].get<double>());
  }
  if (const auto checked = check_polygon(corners); !checked) return tl::unexpected(checked.error());
  return corners;
}

Json entry_json(const team::EntryId& id) { return Json::array({id.robot, id.run, id.sequence}); }

/// Nothing for what is no key.
std::optional<team::EntryId> read_entry(const Json& json) {
  const auto is_count = [](const Json& value) {
    return value.is_number_unsigned() &&
           value.get<std::uint64_t>() <= std::numeric_limits<std::uint32_t>::max();
  };
  if (!json.is_array() || json.size() != 3 || !std::ranges::all_of(json, is_count)) return {};
  if (json[0].get<std::uint64_t>() > std::numeric_limits<std::uint16_t>::max()) return {};
  return team::EntryId{json[0].get<std::uint16_t>(), json[2].get<std::uint32_t>(),
                       json[1].get<std::uint32_t>()};
}

Result<DrawnArea> read_area(const Json& json) {
  if (!json.is_object()) return fail(Errc::kInvalidInput, "an area that is no object");
  DrawnArea area;
  const auto number = json.find("number"), entry = json.find("entry"), corners = json.find("corners_m");
  if (number != json.end() && number->is_number_unsigned()) area.number = number->get<std::uint64_t>();
  const auto key = entry == json.end() ? std::nullopt : read_entry(*entry);
  if ((area.number != 0) == key.has_value())
    return fail(Errc::kInvalidInput, "an area with neither or both of number and entry");
  if (key) area.entry = *key;
  if (const auto kind = json.find("kind"); kind != json.end()) {
    const auto known = kind->is_string() ? types::area_kind_of(kind->get<std::string>()) : std::nullopt;
    if (!known) return fail(Errc::kInvalidInput, "an area of another kind than keep_out and here_first");
    area.kind = *known;
  }
  auto read = read_corners(corners == json.end() ? Json() : *corners);
  if (!read) return tl::unexpected(read.error());
  area.corners_map = std::move(*read);
  return area;
}

}  // namespace

Json corners_json(const Polygon& corners) {
  Json json = Json::array();
  for (const types::Vector2& corner : corners) json.push_back(Json::array({corner.x(), corner.y()}));
  return json;
}

std::string id_of(const DrawnArea& area) {
  if (area.number != 0) return fmt::format("{}", area.number);
  return fmt::format("{}.{}.{}", area.entry.robot, area.entry.run, area.entry.sequence);
}

bool AreaBook::fits(const Polygon& more) const {
  std::size_t corners = more.size();
  for (const DrawnArea& area : areas_) corners += area.corners_map.size();
  return areas_.size() < caps_.areas && corners <= caps_.corners;
}

Result<std::string> AreaBook::draw(const Polygon& corners_map, types::AreaKind kind) {
  if (corners_map.size() > team::kCornersMax) {
    return fail(Errc::kInvalidInput,
                fmt::format("found {} corners, expected at most {}", corners_map.size(), team::kCornersMax));
  }
  if (const auto checked = check_polygon(corners_map); !checked) return tl::unexpected(checked.error());
  if (!fits(corners_map)) {
    return fail(Errc::kBusy, fmt::format("there may be {} areas with {} corners in all: withdraw one",
                                         caps_.areas, caps_.corners));
  }
  areas_.push_back({++last_, {}, corners_map, kind});
  return id_of(areas_.back());
}

Status AreaBook::withdraw(std::string_view id) {
  const auto found = std::ranges::find(areas_, id, &id_of);
  if (found == areas_.end())
    return fail(Errc::kNotFound, fmt::format("there is no area \"{}\": topoctl area list", id));
  if (found->number == 0) withdrawn_.push_back(found->entry);
  areas_.erase(found);
  return {};
}

/// True when it is another than before.
bool AreaBook::take(const TeamAreas::OfMate& area, const Polygon& corners_map) {
  const auto found = std::ranges::find_if(
      areas_, [&](const DrawnArea& drawn) { return drawn.number == 0 && drawn.entry == area.id; });
  if (found != areas_.end()) {
    if (found->corners_map == corners_map) return false;
    found->corners_map = corners_map;
    return true;
  }
  if (!fits(corners_map)) {
    trouble_ =
        fmt::format("an area of robot {} is not in force here: there are enough already", area.id.robot);
    return false;
  }
  areas_.push_back({0, area.id, corners_map, area.kind});
  return true;
}

bool AreaBook::note(const TeamAreas& team) {
  trouble_.clear();
  const auto is_over = [&](const DrawnArea& area) {
    return area.number != 0 ? std::ranges::count(team.own_withdrawn, area.number) > 0
                            : std::ranges::count(team.withdrawn, area.entry) > 0;
  };
  bool changed = std::erase_if(areas_, is_over) > 0;
  std::erase_if(withdrawn_, [&](const auto& id) { return std::ranges::count(team.withdrawn, id) > 0; });
  for (const TeamAreas::OfMate& area : team.of_mates) {
    if (std::ranges::count(withdrawn_, area.id) > 0) continue;
    if (area.corners_map) {
      changed = take(area, *area.corners_map) || changed;
    } else if (std::ranges::count(areas_, area.id, &DrawnArea::entry) == 0) {
      trouble_ = fmt::format(
          "an area of robot {} is not in force here: it is not known where that robot's map lies in this one",
          area.id.robot);
    }
  }
  return changed;
}

bool AreaBook::move(const types::MapCorrection& correction) {
  bool any = false;
  for (DrawnArea& area : areas_) {
    if (area.number == 0) continue;
    types::Vector2 sum(0.0, 0.0);
    for (const types::Vector2& corner : area.corners_map) sum += corner;
    const types::Se2 change = correction.around(sum / static_cast<double>(area.corners_map.size()));
    for (types::Vector2& corner : area.corners_map) corner = change * corner;
    any = true;
  }
  return any;
}

types::AreaLimits AreaBook::with(const types::AreaLimits& configured) const {
  types::AreaLimits limits = configured;
  for (const DrawnArea& area : areas_)
    if (area.kind == types::AreaKind::kKeepOut) limits.keep_out.push_back(area.corners_map);
  return limits;
}

std::vector<Polygon> AreaBook::here_first() const {
  std::vector<Polygon> first;
  for (const DrawnArea& area : areas_)
    if (area.kind == types::AreaKind::kHereFirst) first.push_back(area.corners_map);
  return first;
}

AreaWishes AreaBook::wishes() const {
  AreaWishes wishes;
  for (const DrawnArea& area : areas_)
    if (area.number != 0) wishes.own.push_back({area.number, area.corners_map, area.kind});
  wishes.withdrawn = withdrawn_;
  return wishes;
}

Json AreaBook::json() const {
  Json areas = Json::array();
  for (const DrawnArea& area : areas_) {
    const Json robot = area.number != 0 ? Json() : Json(area.entry.robot);
    areas.push_back({{"id", id_of(area)},
                     {"kind", types::to_text(area.kind)},
                     {"robot", robot},
                     {"corners_m", corners_json(area.corners_map)}});
  }
  return {{"areas", std::move(areas)}};
}

std::string AreaBook::text() const {
  Json areas = Json::array(), withdrawn = Json::array();
  for (const DrawnArea& area : areas_) {
    Json json{{"corners_m", corners_json(area.corners_map)}, {"kind", types::to_text(area.kind)}};
    if (area.number != 0) json["number"] = area.number;
    if (area.number == 0) json["entry"] = entry_json(area.entry);
    areas.push_back(std::move(json));
  }
  for (const team::EntryId& id : withdrawn_) withdrawn.push_back(entry_json(id));
  return Json{{"version", kVersion1}, {"last", last_}, {"areas", areas}, {"withdrawn", withdrawn}}.dump(1) +
         "\n";
}

Result<AreaBook> AreaBook::parse(std::string_view text, const AreaCaps& caps) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.value("version", Json()) != kVersion1)
    return fail(Errc::kInvalidInput, "found no object of version 1");
  const auto areas = json.find("areas"), withdrawn = json.find("withdrawn"), last = json.find("last");
  if (areas == json.end() || !areas->is_array() || withdrawn == json.end() || !withdrawn->is_array() ||
      last == json.end() || !last->is_number_unsigned())
    return fail(Errc::kInvalidInput, "expected areas, withdrawn and last");
  AreaBook book(caps);
  book.last_ = last->get<std::uint64_t>();
  for (const Json& told : *areas) {
    auto area = read_area(told);
    if (!area) return tl::unexpected(area.error());
    if (!book.fits(area->corners_map))
      return fail(Errc::kInvalidInput, "more areas or corners than there may be");
    book.last_ = std::max(book.last_, area->number);
    book.areas_.push_back(std::move(*area));
  }
  for (const Json& told : *withdrawn) {
    const auto id = read_entry(told);
    if (!id) return fail(Errc::kInvalidInput, "a withdrawn area without its key");
    book.withdrawn_.push_back(*id);
  }
  return book;
}

}  // namespace topo::daemon
