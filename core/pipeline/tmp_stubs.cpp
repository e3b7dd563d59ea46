#include "core/motion/area_limits.hpp"
#include "core/pipeline/analysis.hpp"
namespace topo::walls {
std::vector<types::Vector2> __attribute__((weak)) wall_points(const WallStore&) { return {}; }
std::vector<types::Vector2> __attribute__((weak)) occupied_points(const grid::DenseMap&) { return {}; }
Compass __attribute__((weak)) entropy_compass(std::span<const types::Vector2>, const CompassParams&) {
  return {};
}
std::vector<types::Segment> __attribute__((weak))
extract_walls(std::span<const types::Vector2>, double, const WallParams&) {
  return {};
}
}  // namespace topo::walls
namespace topo::places {
Skeleton __attribute__((weak)) skeletonise(const grid::DenseMap&, std::span<const float>) { return {}; }
PlaceMap __attribute__((weak)) segment_places(const grid::DenseMap&, std::span<const float>, const Skeleton&,
                                              std::span<const types::Segment>, double, const PlaceParams&) {
  return {};
}
}  // namespace topo::places
namespace topo::goals {
GoalSet __attribute__((weak)) essential_goals(const GoalInput&, const GoalParams&) { return {}; }
std::string_view __attribute__((weak)) to_text(Side) { return ""; }
}  // namespace topo::goals
namespace topo::motion {
bool __attribute__((weak)) allows(const AreaLimits&, const types::Vector2&) { return true; }
}  // namespace topo::motion
