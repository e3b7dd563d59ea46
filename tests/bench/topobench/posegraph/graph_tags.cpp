// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/posegraph/graph_tags.hpp"

#include <array>
#include <utility>

namespace topo::bench {
namespace {

struct Meaning {
  std::string_view part;  ///< of the tag
  std::string_view what;
};

/// Looked through in this order. Tags as in g2o's types, TORO's and iSAM's loaders, and Vertigo.
constexpr std::array<Meaning, 17> kMeanings{{
    {"VERTEX_SE3", "a pose in space, SE(3)"},
    {"VERTEX3", "a pose in space, SE(3)"},
    {"EDGE_SE3", "a relative pose in space, SE(3)"},
    {"EDGE3", "a relative pose in space, SE(3)"},
    {"EDGE_PROJECT", "an image point"},
    {"SWITCH", "a closure with a switch"},
    {"MAXMIX", "a closure of several modes"},
    {"MIXTURE", "a closure of several modes"},
    {"PRIOR", "a prior on a pose"},
    {"GPS", "a prior on a pose"},
    {"BEARING", "a landmark's bearing"},
    {"_XY", "a landmark seen from a pose"},
    {"LANDMARK", "a landmark seen from a pose"},
    {"CALIB", "a calibration of a sensor"},
    {"OFFSET", "a relative pose of sensors beside the robot's centre"},
    {"ODOMETRY", "an edge of iSAM, whose six numbers are no information matrix but its square root"},
    {"EDGE_POINT", "a relation of points"},
}};

bool has(std::string_view tag, std::string_view part) { return tag.find(part) != std::string_view::npos; }

/// Vertices of other kinds say nothing by themselves: the edges to them are refused.
bool ties_nodes(std::string_view tag) {
  return has(tag, "EDGE") || has(tag, "FACTOR") || has(tag, "CONSTRAINT") || has(tag, "PRIOR") ||
         tag == "ODOMETRY" || tag == "LANDMARK" || tag.starts_with("VERTEX_SE3") || tag == "VERTEX3";
}

}  // namespace

GraphLine graph_line_of(std::string_view tag) {
  constexpr std::array<std::pair<std::string_view, GraphLine>, 5> kRead{
      {{"VERTEX_SE2", GraphLine::kVertexG2o},
       {"VERTEX2", GraphLine::kVertexToro},
       {"EDGE_SE2", GraphLine::kEdgeG2o},
       {"EDGE2", GraphLine::kEdgeToro},
       {"FIX", GraphLine::kFix}}};
  for (const auto& [name, line] : kRead) {
    if (tag == name) return line;
  }
  return ties_nodes(tag) ? GraphLine::kOther : GraphLine::kForeign;
}

std::string meaning_of(std::string_view tag) {
  for (const Meaning& meaning : kMeanings) {
    if (has(tag, meaning.part)) return std::string(meaning.what);
  }
  return "a constraint of another kind";
}

}  // namespace topo::bench
