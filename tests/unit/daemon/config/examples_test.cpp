// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "daemon/config/key_table.hpp"
#include "tests/unit/daemon/config/sample.hpp"

namespace topo::daemon {
namespace {

std::string example_path(const std::string& name) {
  const char* folder = std::getenv("TOPOMETRIC_CONFIG");
  return std::string(folder == nullptr ? "config" : folder) + "/" + name;
}

std::string read_all(const std::string& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The example with every "# key = value" and "# [section]" in effect.
std::string uncommented(const std::string& text) {
  std::istringstream in(text);
  std::string out, line;
  while (std::getline(in, line)) {
    std::size_t at = line.starts_with("# ") ? 2 : 0;
    std::size_t end = at;
    while (end < line.size() &&
           (std::islower(line[end]) != 0 || std::isdigit(line[end]) != 0 || line[end] == '_'))
      ++end;
    const bool key = (end > at && line.compare(end, 3, " = ") == 0) || line.starts_with("# [");
    out += (key ? line.substr(at) : line) + "\n";
  }
  return out;
}

class Example : public ::testing::TestWithParam<const char*> {};

TEST_P(Example, HasNoFault) {
  const auto loaded = load_configuration(example_path(GetParam()));
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  EXPECT_EQ(faults_text(*loaded), "");
  EXPECT_TRUE(loaded->values.coronal.present);
}

TEST_P(Example, NamesEveryKeyAndShowsItsDefault) {
  const std::string text = read_all(example_path(GetParam()));
  auto all = parse_configuration(uncommented(text), GetParam());
  EXPECT_EQ(faults_text(all), "");  // a commented key that does not exist would be a fault here
  const auto active = parse_configuration(text, GetParam());
  for (const auto& key : key_table()) {
    EXPECT_TRUE(all.places.contains(key.path)) << key.path << " is not in the example";
    if (active.places.contains(key.path) || key.required) continue;
    EXPECT_EQ(value_text(key, all.values), value_text(key, Configuration{}))
        << key.path << ": default shown wrongly";
  }
}

TEST_P(Example, EffectiveTextReadsBackTheSame) {
  const auto loaded = load_configuration(example_path(GetParam()));
  ASSERT_TRUE(loaded.has_value());
  const auto again = parse_configuration(effective_text(*loaded), "again.toml");
  EXPECT_EQ(faults_text(again), "");
  for (const auto& key : key_table()) {
    EXPECT_EQ(value_text(key, again.values), value_text(key, loaded->values)) << key.path;
  }
}

/// It leaves out what p3dx.toml says already.
TEST(ExampleOnCan, HasNoFault) {
  const auto loaded = load_configuration(example_path("p3dx-can.toml"));
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  EXPECT_EQ(faults_text(*loaded), "");
  EXPECT_EQ(loaded->values.base.address, "can:can0:0");
}

TEST(ExampleOnCan, AScannerThereIsRefused) {
  std::string text = read_all(example_path("p3dx-can.toml"));
  const std::string tcp = "tcp:192.168.0.10:10940";
  text.replace(text.find(tcp), tcp.size(), "can:can0:1");
  EXPECT_NE(faults_text(parse_configuration(text, "wrong.toml"))
                .find("a CAN bus carries the base and nothing else"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Config, Example, ::testing::Values("p3dx.toml", "p3at.toml", "simulation.toml"));

TEST(KeyTable, IsDocumentedAndItsDefaultsAreAccepted) {
  std::set<std::string> paths;
  for (const auto& key : key_table()) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path << " stands twice";
    EXPECT_FALSE(key.doc.empty()) << key.path;
    EXPECT_EQ(key.doc.find('\n'), std::string_view::npos) << key.path;
    const bool unit_in_name =
        key.path.ends_with("_m") || key.path.ends_with("_s") || key.path.ends_with("_rad") ||
        key.path.ends_with("_mps") || key.path.ends_with("_radps") || key.path.ends_with("_mps2") ||
        key.path.ends_with("_v") || key.path.ends_with("_radps2") || key.path.ends_with("_per_m") ||
        key.path.ends_with("_per_rad") || key.path.ends_with("_mb") || key.path.ends_with("_ms") ||
        key.path.ends_with("_deg");
    EXPECT_EQ(unit_in_name, !key.unit.empty()) << key.path;
    if (key.required) continue;
    const std::string text = std::string("[") + std::string(key.section()) + "]\n" + std::string(key.name()) +
                             " = " + value_text(key, Configuration{}) + "\n";
    for (const auto& fault : faults_of(text)) {
      EXPECT_EQ(fault.find(key.path + ": "), std::string::npos) << fault;
    }
  }
}

TEST(MapperParams, HaveTheScannersInTheirPlaces) {
  const auto loaded = load_configuration(example_path("p3at.toml"));
  ASSERT_TRUE(loaded.has_value());
  const auto params = mapper_params(loaded->values);
  EXPECT_EQ(params.T_base_laser, (types::Se2{0.125, 0.0, 0.0}));
  EXPECT_EQ(params.coronal.z_m, loaded->values.coronal.z_m);
}

TEST(EffectiveText, NamesTheOrigin) {
  const std::string text = effective_text(parse_configuration(kSmallest, "f.toml"));
  EXPECT_NE(text.find("model = \"p3dx\"  # f.toml:2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("id = 1  # default\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("[scanner.coronal]"), std::string::npos) << text;
}

}  // namespace
}  // namespace topo::daemon
