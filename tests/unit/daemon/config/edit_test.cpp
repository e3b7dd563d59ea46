// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/edit.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace topo::daemon {
namespace {

constexpr const char* kText = R"(# A robot.
[robot]
name = "a#b"             # its name
model = "p3dx"

[base]
# track_m = 0.0          # effective track
# prose about track_m = nothing
sonar = true
)";

std::string with(const char* path, const char* value) {
  const std::vector<KeyEdit> edits{{path, value}};
  return edited(kText, edits);
}

TEST(EditedConfiguration, SetsAValueAndKeepsItsComment) {
  EXPECT_NE(with("robot.name", "\"c\"").find("name = \"c\"               # its name\n"), std::string::npos);
}

TEST(EditedConfiguration, SetsAKeyThatWasCommentedOut) {
  const std::string text = with("base.track_m", "0.361");
  EXPECT_NE(text.find("\ntrack_m = 0.361          # effective track\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# prose about"), std::string::npos);
}

TEST(EditedConfiguration, AddsAKeyAtTheEndOfItsSection) {
  EXPECT_NE(with("robot.id", "4").find("model = \"p3dx\"\nid = 4\n\n[base]"), std::string::npos);
}

TEST(EditedConfiguration, AddsASection) {
  EXPECT_TRUE(with("scanner.front.x_m", "0.1").ends_with("sonar = true\n\n[scanner.front]\nx_m = 0.1\n"));
}

TEST(EditedConfiguration, WithoutEditsIsTheSame) { EXPECT_EQ(edited(kText, {}), kText); }

TEST(EditedConfiguration, ALongerValueTakesItsRoom) {
  EXPECT_NE(with("robot.name", "\"a-much-longer-name\"").find("name = \"a-much-longer-name\" # its name\n"),
            std::string::npos);
}

TEST(WithoutSection, CommentsOutItsLinesAndNoOthers) {
  const std::string text = without_section(kText, "base");
  EXPECT_NE(text.find("\n# [base]\n# track_m = 0.0          # effective track\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n# sonar = true\n"), std::string::npos);
  EXPECT_NE(text.find("\nmodel = \"p3dx\"\n"), std::string::npos);
  EXPECT_EQ(without_section(kText, "nothing"), kText);
  EXPECT_EQ(without_section(text, "base"), text);
}

}  // namespace
}  // namespace topo::daemon
