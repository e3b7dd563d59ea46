// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes one map in every form into the folder given; read_with_python.py knows what must be in it.
#include <cstdio>
#include <fstream>
#include <random>
#include <string>

#include "daemon/mapfile/cloud.hpp"
#include "daemon/mapfile/map_image.hpp"
#include "daemon/mapfile/picture.hpp"
#include "daemon/mapfile/places_geojson.hpp"

namespace {

/// Places of any form: cells of three labels at random, which touch over corners and enclose each other.
std::string random_places(unsigned seed) {
  using namespace topo;
  std::mt19937 random(seed);
  const unsigned share = 2 + seed % 8;
  analysis::Analysis a;
  a.map.resolution_m = 0.05;
  a.map.box = {{0, 0}, {31, 23}};
  a.map.cells.assign(32U * 24U, grid::CellState::kUnknown);
  a.places.places.resize(3);
  for (int y = 1; y < 23; ++y) {
    for (int x = 1; x < 31; ++x) {
      if (random() % 10 >= share) continue;
      const auto cell = static_cast<std::uint32_t>(a.map.index({x, y}));
      const auto label = static_cast<std::uint16_t>(1 + random() % 3);
      a.map.cells[cell] = grid::CellState::kFree;
      a.places.labels.append(cell, cell + 1, label);
      a.places.places[label - 1U].area_m2 += 0.05 * 0.05;
    }
  }
  return daemon::places_geojson(a, {}, {-1.5, 2.25});
}

}  // namespace

int main(int argc, char** argv) {
  using namespace topo::daemon;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  MapImage map{3, 2, 0.05, {-1.5, 2.25, 0.0}, {}};
  map.cells = {MapCell::kFree,    MapCell::kOccupied, MapCell::kUnknown,
               MapCell::kUnknown, MapCell::kUnknown,  MapCell::kFree};
  Picture picture = picture_of(map);
  picture.set(2, 1, {255, 0, 7});
  const CloudPoint points[] = {{1.0F, -2.0F, 0.25F}, {0.5F, 0.125F, 3.0F}};
  for (const auto& status :
       {save_map(folder, map), save_png(folder + "/map.png", picture),
        save_cloud(folder + "/cloud.ply", points), save_cloud(folder + "/empty.ply", {})}) {
    if (!status.has_value()) {
      std::fprintf(stderr, "%s\n", status.error().message.c_str());
      return 1;
    }
  }
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::ofstream(folder + "/places-" + std::to_string(seed) + ".geojson") << random_places(seed);
  }
  return 0;
}
