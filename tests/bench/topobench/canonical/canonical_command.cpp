// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/canonical/canonical_command.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/slam/canonical_map.hpp"
#include "core/slam/keyframe_codec.hpp"
#include "core/types/bytes.hpp"
#include "daemon/session/session_reader.hpp"

namespace topo::bench {
namespace {

std::string hash_text(const types::ByteWriter& content) {
  return fmt::format("{:016x}", XXH64(content.bytes().data(), content.bytes().size(), 0));
}

void write_id(types::ByteWriter& out, const slam::KeyframeId& id) {
  out.varint(id.robot);
  out.varint(id.run);
  out.varint(id.sequence);
}

void write_pose(types::ByteWriter& out, const types::Se2& pose) {
  for (const double value : {pose.x_m, pose.y_m, pose.theta_rad})
    out.integer(std::bit_cast<std::uint64_t>(value));
}

struct Sets {
  slam::KeyframeSet keyframes;
  slam::RelationSet relations;
};

Sets sets_of(const slam::Session& session) {
  Sets sets;
  for (const slam::KeyframePtr& keyframe : session.keyframes) sets.keyframes.insert(keyframe);
  for (const slam::Edge& edge : session.edges) {
    sets.relations.insert({session.keyframes[edge.from]->id, session.keyframes[edge.to]->id},
                          {edge.T_from_to, edge.information, edge.robust});
  }
  return sets;
}

std::string keyframes_hash(const slam::KeyframeSet& set) {
  types::ByteWriter out;
  for (const auto& [id, keyframe] : set.keyframes()) out.append(slam::encode_keyframe(*keyframe));
  return hash_text(out);
}

std::string relations_hash(const slam::RelationSet& set) {
  types::ByteWriter out;
  for (const auto& [key, relation] : set.relations()) {
    write_id(out, key.first);
    write_id(out, key.second);
    write_pose(out, relation.T_from_to);
    for (Eigen::Index i = 0; i < 9; ++i)
      out.integer(std::bit_cast<std::uint64_t>(relation.information(i / 3, i % 3)));
    out.integer(static_cast<std::uint8_t>(relation.robust ? 1 : 0));
  }
  return hash_text(out);
}

/// Ids, poses and cells of the map from an origin.
nlohmann::json map_json(const slam::CanonicalMap& canonical) {
  types::ByteWriter poses, cells;
  for (std::size_t i = 0; i < canonical.ids.size(); ++i) {
    write_id(poses, canonical.ids[i]);
    write_pose(poses, canonical.poses[i]);
  }
  std::size_t known = 0;
  canonical.map->grid().for_each_known([&](grid::CellIndex cell, grid::CellState state) {
    ++known;
    cells.integer(cell.x);
    cells.integer(cell.y);
    cells.integer(static_cast<std::uint8_t>(state));
  });
  return {{"keyframes", canonical.ids.size()},
          {"poses", hash_text(poses)},
          {"known_cells", known},
          {"cells", hash_text(cells)}};
}

/// A map for every group of keyframes that relations connect, each from the lowest key in it.
nlohmann::json maps_json(const Sets& sets) {
  nlohmann::json maps = nlohmann::json::array();
  std::set<slam::KeyframeId> drawn;
  for (const auto& [id, keyframe] : sets.keyframes.keyframes()) {
    if (drawn.contains(id)) continue;
    const slam::CanonicalMap canonical = slam::canonical_map(sets.keyframes, sets.relations, id, {}, {});
    drawn.insert(id);
    drawn.insert(canonical.ids.begin(), canonical.ids.end());
    maps.push_back(map_json(canonical));
  }
  return maps;
}

nlohmann::json origins_json(const slam::KeyframeSet& set) {
  std::map<std::string, std::size_t> counts;
  for (const auto& [id, keyframe] : set.keyframes()) ++counts[fmt::format("{}/{:08x}", id.robot, id.run)];
  return counts;
}

}  // namespace

types::Status run_canonical(const CanonicalCommand& command) {
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& path : command.sessions) {
    const auto loaded = daemon::load_session(path);
    if (!loaded) return tl::unexpected(loaded.error());
    if (auto there = daemon::check_map(*loaded, path); !there) return there;
    const Sets sets = sets_of(loaded->session);
    all.push_back({{"session", path},
                   {"origins", origins_json(sets.keyframes)},
                   {"keyframes", keyframes_hash(sets.keyframes)},
                   {"relations_count", sets.relations.relations().size()},
                   {"relations", relations_hash(sets.relations)},
                   {"maps", maps_json(sets)}});
  }
  fmt::print("{}\n", all.dump(2));
  return {};
}

}  // namespace topo::bench
