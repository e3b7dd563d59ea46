// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes one map in every form into the folder given; read_with_python.py knows what must be in it.
#include <cstdio>

#include "daemon/mapfile/cloud.hpp"
#include "daemon/mapfile/map_image.hpp"
#include "daemon/mapfile/picture.hpp"

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
  for (const auto& status : {save_map(folder, map), save_png(folder + "/map.png", picture),
                             save_cloud(folder + "/cloud.ply", points)}) {
    if (!status.has_value()) {
      std::fprintf(stderr, "%s\n", status.error().message.c_str());
      return 1;
    }
  }
  return 0;
}
