// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Map files of any content: refused with a reason that names the file, or a map in one piece that is written
// and read again as the same. The input is the YAML file, a zero byte, and the image that it should name.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/mapfile/grey_image.hpp"
#include "daemon/mapfile/map_image.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace {

using namespace topo::daemon;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_image(std::string_view content) {
  for (const auto decode : {&decode_pgm, &decode_png}) {
    const auto image = decode("image", content);
    if (!image) {
      require(image.error().message.starts_with("image"));
      continue;
    }
    const auto pixels = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
    require(image->width > 0 && image->height > 0 && image->pixels.size() == pixels);
    require(image->transparent.empty() || image->transparent.size() == pixels);
  }
}

void check_map(const topo::daemon::testing::TempDir& folder, const std::string& yaml) {
  const auto map = load_map(yaml);
  if (!map) {
    require(!map.error().message.empty());
    return;
  }
  require(map->width > 0 && map->height > 0 && std::isfinite(map->resolution_m) && map->resolution_m > 0.0);
  require(map->cells.size() == static_cast<std::size_t>(map->width) * static_cast<std::size_t>(map->height));
  if (map->cells.size() > 100'000) return;
  const std::vector<std::byte> pgm = encode_pgm(*map);  // as save_map() writes it, without waiting for a disk
  (void)folder.write("image", {reinterpret_cast<const char*>(pgm.data()), pgm.size()});
  const auto again = load_map(folder.write("again.yaml", encode_map_yaml(*map, "image")));
  require(again.has_value() && again->cells == map->cells && again->width == map->width);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const topo::daemon::testing::TempDir folder;  // of all runs
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  const std::string_view image = bytes.substr(std::min(end + 1, bytes.size()));
  check_image(image);
  (void)folder.write("image", image);
  check_map(folder, folder.write("fuzz.yaml", bytes.substr(0, end)));
  return 0;
}
