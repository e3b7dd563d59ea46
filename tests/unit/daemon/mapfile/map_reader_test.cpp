// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <zlib.h>

#include "daemon/mapfile/map_image.hpp"
#include "daemon/mapfile/picture.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using types::Errc;

const std::string kPgm = "P5 3 1 255\n" + std::string("\xFE\xCD\0", 3);
const std::string kYaml = "image: m.pgm\nresolution: 0.1\norigin: [1, -2, 0.5]\n";

class MapReaderTest : public ::testing::Test {
 protected:
  types::Result<MapImage> load(const std::string& yaml, const std::string& image) {
    static_cast<void>(dir_.write("m.pgm", image));
    return load_map(dir_.write("m.yaml", yaml));
  }
  std::string error(const std::string& yaml, const std::string& image = kPgm) {
    const auto map = load(yaml, image);
    EXPECT_FALSE(map.has_value());
    if (map.has_value()) return "";
    EXPECT_EQ(map.error().code, Errc::kInvalidInput);
    return map.error().message;
  }
  testing::TempDir dir_;
};

TEST_F(MapReaderTest, ReadsRawAndPlainPgmWithComments) {
  for (const std::string& image : {kPgm, std::string("P2\n# by hand\n3 1 # size\n255\n254 205\n0\n")}) {
    const auto map = load(kYaml, image);
    ASSERT_TRUE(map.has_value()) << map.error().message;
    EXPECT_THAT(map->cells, ElementsAre(MapCell::kFree, MapCell::kUnknown, MapCell::kOccupied));
    EXPECT_EQ(map->origin, (types::Se2{1, -2, 0.5}));
    EXPECT_DOUBLE_EQ(map->resolution_m, 0.1);
  }
}

TEST_F(MapReaderTest, TheFirstRowOfTheImageIsTheHighestOfTheMap) {
  const auto map = load(kYaml, "P2 1 2 255 254 0");
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->at(0, 0), MapCell::kOccupied);
  EXPECT_EQ(map->at(0, 1), MapCell::kFree);
}

TEST_F(MapReaderTest, FollowsNegateThresholdsAndTheGreatestValue) {
  const auto negated = load(kYaml + "negate: 1\n", kPgm);
  ASSERT_TRUE(negated.has_value());
  EXPECT_THAT(negated->cells, ElementsAre(MapCell::kOccupied, MapCell::kOccupied, MapCell::kFree));
  const auto wide = load(kYaml + "occupied_thresh: 0.9\nfree_thresh: 0.5\n", "P2 3 1 255 200 100 10");
  ASSERT_TRUE(wide.has_value());
  EXPECT_THAT(wide->cells, ElementsAre(MapCell::kFree, MapCell::kUnknown, MapCell::kOccupied));
  const auto bits = load(kYaml, "P2 2 1 1 1 0");
  ASSERT_TRUE(bits.has_value());
  EXPECT_THAT(bits->cells, ElementsAre(MapCell::kFree, MapCell::kOccupied));
}

TEST_F(MapReaderTest, ReadsPng) {
  Picture picture(3, 1, {254, 254, 254});
  picture.set(1, 0, {205, 205, 205});
  picture.set(2, 0, {0, 0, 0});
  ASSERT_TRUE(save_png(dir_.file("m.png"), picture).has_value());
  const auto map =
      load_map(dir_.write("m.yaml", "image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\nmode: trinary\n"));
  ASSERT_TRUE(map.has_value()) << map.error().message;
  EXPECT_THAT(map->cells, ElementsAre(MapCell::kFree, MapCell::kUnknown, MapCell::kOccupied));
}

TEST_F(MapReaderTest, RefusesAPngThatClaimsMoreThanItHolds) {
  ASSERT_TRUE(save_png(dir_.file("m.png"), Picture(300, 200, {254, 254, 254})).has_value());
  const std::string yaml =
      dir_.write("m.yaml", "image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\nmode: trinary\n");
  const auto even = load_map(yaml);
  ASSERT_TRUE(even.has_value()) << "one colour packs best: " << even.error().message;
  std::string bytes = testing::read_all(dir_.file("m.png"));
  constexpr std::size_t kWidth = 16, kCrc = 29;
  const std::string wide("\x00\x00\x27\x10\x00\x00\x27\x10", 8);  // 10,000 x 10,000
  bytes.replace(kWidth, wide.size(), wide);
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + 12), 17);
  for (std::size_t i = 0; i < 4; ++i) bytes[kCrc + i] = static_cast<char>(crc >> (24 - 8 * i));
  static_cast<void>(dir_.write("m.png", bytes));
  const auto map = load_map(yaml);
  ASSERT_FALSE(map.has_value());
  EXPECT_EQ(map.error().code, Errc::kInvalidInput);
  EXPECT_THAT(map.error().message, HasSubstr("claims 10000 x 10000 pixels"));
}

TEST_F(MapReaderTest, ReadsTheModesOfMapServer) {
  static_cast<void>(dir_.write("m.pgm", "P2 6 1 255 0 24 66 101 205 255"));
  const auto cells = [&](const std::string& mode) {
    const auto map = load_map(dir_.write("m.yaml", kYaml + "free_thresh: 0.25\nmode: " + mode + "\n"));
    EXPECT_TRUE(map.has_value()) << map.error().message;
    return map.has_value() ? map->cells : std::vector<MapCell>();
  };
  constexpr auto kFree = MapCell::kFree, kUnknown = MapCell::kUnknown, kOccupied = MapCell::kOccupied;
  const auto by_shade = ElementsAre(kOccupied, kOccupied, kOccupied, kUnknown, kFree, kFree);
  EXPECT_THAT(cells("trinary"), by_shade);
  EXPECT_THAT(cells("scale"), by_shade);
  EXPECT_THAT(cells("raw"), ElementsAre(kFree, kFree, kOccupied, kUnknown, kUnknown, kUnknown));
}

TEST_F(MapReaderTest, ReadsSixteenBits) {
  // 0.65 of occupancy is not over 0.65; one step more is. In eight bits both would be one value.
  const auto map = load(kYaml + "occupied_thresh: 0.65\n",
                        "P5 4 1 60000\n" + std::string("\xEA\x60\x52\x08\x52\x07\x00\x00", 8));
  ASSERT_TRUE(map.has_value()) << map.error().message;
  EXPECT_THAT(map->cells,
              ElementsAre(MapCell::kFree, MapCell::kUnknown, MapCell::kOccupied, MapCell::kOccupied));
  const auto text = load(kYaml, "P2 2 1 65535 65535 0");
  ASSERT_TRUE(text.has_value()) << text.error().message;
  EXPECT_THAT(text->cells, ElementsAre(MapCell::kFree, MapCell::kOccupied));
}

TEST_F(MapReaderTest, ATextConvertersHeadIsReadRightOrRefused) {
  const std::string pixels("\xFE\xCD\0", 3), head = "P5\r\n# c\r\n3 1\r\n255\r\n";
  const auto expected = ElementsAre(MapCell::kFree, MapCell::kUnknown, MapCell::kOccupied);
  for (const std::string& image :
       {head + pixels, "P5 3 1 255 \n" + pixels, "P5 3 1 255\r" + pixels, "P5 3 1 255\n" + pixels + "\n"}) {
    const auto map = load(kYaml, image);
    ASSERT_TRUE(map.has_value()) << map.error().message;
    EXPECT_THAT(map->cells, expected);
  }
  // A first pixel of 10 or 13 is a pixel where the number of bytes says so.
  const auto dark = load(kYaml, "P5 3 1 255\n" + std::string("\n\xCD\xFE"));
  ASSERT_TRUE(dark.has_value()) << dark.error().message;
  EXPECT_THAT(dark->cells, ElementsAre(MapCell::kOccupied, MapCell::kUnknown, MapCell::kFree));
  EXPECT_THAT(error(kYaml, head + pixels + "\r\n"), HasSubstr("a text converter?"));
  EXPECT_THAT(error(kYaml, head + std::string("\xFE\xCD\r\n", 4)), HasSubstr("a text converter?"));
}

TEST_F(MapReaderTest, ReadsYamlsWordsForNegate) {
  for (const char* word : {"1", "true", "True", "TRUE", "yes", "Yes", "on", "y", "\"1\""}) {
    const auto map = load(kYaml + "negate: " + word + "\n", kPgm);
    ASSERT_TRUE(map.has_value()) << map.error().message;
    EXPECT_EQ(map->cells[0], MapCell::kOccupied) << word;
  }
  for (const char* word : {"0", "false", "False", "no", "No", "off", "n"}) {
    const auto map = load(kYaml + "negate: " + word + "\n", kPgm);
    ASSERT_TRUE(map.has_value()) << map.error().message;
    EXPECT_EQ(map->cells[0], MapCell::kFree) << word;
  }
  EXPECT_THAT(error(kYaml + "negate: perhaps\n"), HasSubstr("found \"perhaps\", expected 0 or 1, or YAML's"));
  EXPECT_THAT(error(kYaml + "negate: [1]\n"), HasSubstr("key negate: found a list of 1"));
}

TEST_F(MapReaderTest, AYawThatIsNoNumberIsNoneWithAWarning) {
  for (const char* yaw : {"nan", "-nan", ".nan", "-.NaN", "NaN", "nan(ind)", "-nan(ind)"}) {
    const auto map = load("image: m.pgm\nresolution: 0.1\norigin: [1, -2, " + std::string(yaw) + "]\n", kPgm);
    ASSERT_TRUE(map.has_value()) << map.error().message;
    EXPECT_EQ(map->origin, (types::Se2{1, -2, 0}));
    EXPECT_THAT(map->warnings, ElementsAre(HasSubstr("line 3: key origin: took the yaw \"")));
  }
  EXPECT_TRUE(load(kYaml, kPgm)->warnings.empty());
  for (const char* origin : {"[nan, 0, 0]", "[0, -nan, 0]", "[0, 0, inf]", "[0, 0, nancy]"})
    EXPECT_THAT(error("image: m.pgm\nresolution: 1\norigin: " + std::string(origin) + "\n"),
                HasSubstr("key origin: found"));
}

TEST_F(MapReaderTest, TakesThePictureBesideWhereThePathIsAnothers) {
  for (const char* path : {"/nowhere/maps/m.pgm", "maps/m.pgm", "'C:\\maps\\m.pgm'"}) {
    const auto map = load("image: " + std::string(path) + "\nresolution: 1\norigin: [0, 0, 0]\n", kPgm);
    ASSERT_TRUE(map.has_value()) << map.error().message;
    EXPECT_EQ(map->width, 3);
    EXPECT_THAT(map->warnings, ElementsAre(HasSubstr("is not there, took ")));
  }
  const auto gone = load("image: /nowhere/gone.pgm\nresolution: 1\norigin: [0, 0, 0]\n", kPgm);
  ASSERT_FALSE(gone.has_value());
  EXPECT_THAT(gone.error().message, HasSubstr("/nowhere/gone.pgm"));
  EXPECT_EQ(gone.error().code, Errc::kNotFound);
  EXPECT_THAT(error("image: /nowhere/m.pgm\nresolution: 1\norigin: [0, 0, 0]\n", "P5 3"),
              HasSubstr("m.pgm: byte"));
}

TEST_F(MapReaderTest, SaysKeyFoundAndExpected) {
  EXPECT_THAT(error(""), HasSubstr("m.yaml: found no keys"));
  EXPECT_THAT(error("image: [\n"), HasSubstr("m.yaml: line "));
  EXPECT_THAT(error("resolution: 0.1\norigin: [0, 0, 0]\n"), HasSubstr("key image: found nothing"));
  EXPECT_THAT(error("image: m.pgm\norigin: [0, 0, 0]\n"),
              HasSubstr("key resolution: found nothing, expected a number"));
  EXPECT_THAT(error("image: m.pgm\nresolution: .nan\norigin: [0, 0, 0]\n"),
              HasSubstr("line 2: key resolution: found \".nan\""));
  EXPECT_THAT(error("image: m.pgm\nresolution: -1\norigin: [0, 0, 0]\n"),
              HasSubstr("key resolution: found \"-1\""));
  EXPECT_THAT(error("image: m.pgm\nresolution: 1\norigin: [0, 0]\n"),
              HasSubstr("line 3: key origin: found a list of 2"));
  EXPECT_THAT(error("image: m.pgm\nresolution: 1\norigin: [0, x, 0]\n"),
              HasSubstr("key origin: found \"x\""));
  EXPECT_THAT(error(kYaml + "negate: 2\n"), HasSubstr("key negate: found \"2\", expected 0 or 1"));
  EXPECT_THAT(error(kYaml + "mode: sepia\n"),
              HasSubstr("key mode: found \"sepia\", expected trinary, scale or raw"));
  EXPECT_THAT(error(kYaml + "free_thresh: 0.8\n"),
              HasSubstr("key free_thresh: found \"0.8\", expected at most occupied_thresh"));
}

TEST_F(MapReaderTest, RefusesAKeyThatIsGivenTwice) {
  EXPECT_THAT(error(kYaml + "resolution: 0.05\n"),
              HasSubstr("line 4: key resolution: found it once more, expected one only: line 2 has it"));
  EXPECT_THAT(error(kYaml + "colour: red\ncolour: red\n"), HasSubstr("line 5: key colour"));
}

TEST_F(MapReaderTest, SaysWhatIsWrongWithTheImage) {
  EXPECT_THAT(error(kYaml, ""), HasSubstr("m.pgm: byte 0: found other content"));
  EXPECT_THAT(error(kYaml, "P6 1 1 255 abc"), HasSubstr("expected a PGM (P2, P5) or PNG image"));
  EXPECT_THAT(error(kYaml, "P5 3"), HasSubstr("found the end of the file as height"));
  EXPECT_THAT(error(kYaml, "P5 99999 1 255\n"), HasSubstr("found 99999 as width"));
  EXPECT_THAT(error(kYaml, "P5 32768 32768 255\n"), HasSubstr("an image of 32768 x 32768 pixels"));
  EXPECT_THAT(error(kYaml, "P5 3 1 65536\n123456"),
              HasSubstr("found 65536 as greatest value, expected 1 to 65535"));
  EXPECT_THAT(error(kYaml, "P5 3 1 65535\n12345"),
              HasSubstr("found 5 bytes of pixels (truncated file), expected at least 6"));
  EXPECT_THAT(error(kYaml, kPgm.substr(0, kPgm.size() - 1)),
              HasSubstr("found 2 bytes of pixels (truncated file), expected at least 3"));
  EXPECT_THAT(error(kYaml, "P2 3 1 255 1 2 x"), HasSubstr("found no number as pixel"));
  EXPECT_THAT(error(kYaml, "P2 3 1 9 1 2 10"), HasSubstr("found 10 as pixel, expected 0 to 9"));
  EXPECT_THAT(error(kYaml, "\x89PNG\r\n\x1a\n garbage"), HasSubstr("a damaged PNG file"));
}

TEST_F(MapReaderTest, NamesFilesThatAreNotThere) {
  const auto yaml = load_map(dir_.file("none.yaml"));
  ASSERT_FALSE(yaml.has_value());
  EXPECT_EQ(yaml.error().code, Errc::kNotFound);
  EXPECT_THAT(yaml.error().message, HasSubstr("none.yaml"));
  const auto image = load_map(dir_.write("m.yaml", "image: gone.pgm\nresolution: 1\norigin: [0, 0, 0]\n"));
  ASSERT_FALSE(image.has_value());
  EXPECT_EQ(image.error().code, Errc::kNotFound);
  EXPECT_THAT(image.error().message, HasSubstr("gone.pgm"));
}

}  // namespace
}  // namespace topo::daemon
