// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/pipeline/map_drawing.hpp"
#include "core/pipeline/mapping_step.hpp"
#include "core/pipeline/scan_pairing.hpp"
#include "core/slam/arrival_trial.hpp"

// State that mapping keeps from step to step; private to mapping_step.cpp and mapping_state.cpp.
namespace topo::pipeline {

/// Data that waits for the next keyframe boundary.
struct MappingNews {
  std::vector<slam::LoopAnswer> answers;
  bool has_mates_answer = false;  ///< one of the answers concerns a team-mate's keyframe
  std::vector<slam::KeyframePtr> mates_keyframes;
  std::vector<slam::FoundRelation> mates_relations;
  std::vector<std::pair<slam::RelationKey, slam::Relation>> known;  ///< relations to team-mates

  /// True when there is news of team-mates, for which a standing robot need not make a keyframe.
  [[nodiscard]] bool of_mates() const {
    return !mates_keyframes.empty() || !mates_relations.empty() || !known.empty() || has_mates_answer;
  }
};

struct MappingState::Impl {
  Impl(const slam::MapperParams& given, const slam::Origin& origin, const types::Se2& start,
       const MappingStepParams& of_step)
      : params(given),
        step(of_step),
        pairing(given.odometry_wait_s, of_step),
        mapper(given, origin, start),
        drawing(given, of_step.drawing),
        columns(given.coronal, given.columns) {}

  /// `looks_back`: an idle robot may ask for a search of its past.
  void run(MappingOutput& output, bool flush, bool looks_back);
  void place(const PairedScan& paired, bool looks_back, MappingOutput& output);
  void pass_boundary(MappingOutput& output);
  void look_back(MappingOutput& output);
  void join_news(MappingOutput& output);
  [[nodiscard]] bool has_news() const {
    return news.of_mates() || mapper.has_mates_to_ask_about() || drawing.has_news();
  }

  slam::MapperParams params;
  MappingStepParams step;
  ScanPairing pairing;
  slam::Mapper mapper;
  MapDrawing drawing;
  walls::ColumnCollector columns;
  MappingNews news;
  std::optional<slam::ArrivalTrial> trial;  ///< of a session's map; nothing: a map of its own
  slam::Cloud cloud;
  types::Stamp placed{};  ///< stamp of the newest front scan placed
  types::Stamp drawn{};   ///< the same, when the map was last drawn
  types::Stamp looked{};  ///< the same, when the robot was last found idle, or made a keyframe
  std::uint64_t revision = 0;
};

}  // namespace topo::pipeline
