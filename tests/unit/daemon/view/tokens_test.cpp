// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/tokens.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "daemon/view/rights.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

KeptToken kept(const std::string& name, const std::string& token) {
  return {name, "2026-01-01T00:00:00Z", token_hash(token)};
}

TEST(Tokens, AreLongAndNeverTheSame) {
  const auto one = make_token(), other = make_token();
  ASSERT_TRUE(one.has_value() && other.has_value());
  EXPECT_THAT(*one, MatchesRegex("[a-z2-9]{4}-[a-z2-9]{4}-[a-z2-9]{4}-[a-z2-9]{4}-[a-z2-9]{4}"));
  EXPECT_NE(*one, *other);
}

TEST(Tokens, AreKnownHoweverTheyAreWritten) {
  EXPECT_EQ(token_hash("ABCD-efgh"), token_hash("abcdefgh"));
  EXPECT_EQ(token_hash("ab cd"), token_hash("abcd"));
  EXPECT_NE(token_hash("abcd"), token_hash("abce"));
  // FIPS 180-4, its example of one block.
  EXPECT_EQ(token_hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Tokens, OutliveTheProgramAsHashesOnly) {
  const testing::TempDir dir;
  const std::string folder = dir.file("view");
  const std::vector<KeptToken> tokens{kept("desk", "aaaa"), kept("phone", "bbbb")};
  EXPECT_TRUE(load_tokens(folder)->empty()) << "no file, no tokens";
  ASSERT_TRUE(save_tokens(folder, tokens).has_value());
  const auto loaded = load_tokens(folder);
  ASSERT_TRUE(loaded.has_value());
  EXPECT_EQ(*loaded, tokens);
  EXPECT_EQ(testing::read_all(tokens_path(folder)).find("aaaa"), std::string::npos);
  struct stat info {};
  ASSERT_EQ(::stat(folder.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0700U);
}

TEST(Tokens, ADamagedFileNamesTheLine) {
  const testing::TempDir dir;
  const std::string path = dir.write("tokens", tokens_text({kept("desk", "aaaa")}) + "nonsense\n");
  const auto loaded = load_tokens(dir.str());
  ASSERT_FALSE(loaded.has_value());
  EXPECT_THAT(loaded.error().message, HasSubstr(path + ": line 2"));
}

TEST(Tokens, NamesArePlain) {
  EXPECT_TRUE(is_token_name("Desk-1_a"));
  for (const char* name : {"", "a b", "a\nb", "ä"}) EXPECT_FALSE(is_token_name(name)) << name;
  EXPECT_FALSE(is_token_name(std::string(33, 'a')));
}

TEST(Rights, ARevokedTokenEndsAtOnce) {
  const testing::TempDir dir;
  Rights rights(dir.str());
  EXPECT_FALSE(rights.hold(token_hash("aaaa")));
  ASSERT_TRUE(save_tokens(dir.str(), {kept("desk", "aaaa"), kept("phone", "bbbb")}).has_value());
  EXPECT_TRUE(rights.hold(token_hash("aaaa")));
  EXPECT_TRUE(rights.hold(token_hash("bbbb")));
  EXPECT_FALSE(rights.hold(token_hash("cccc")));
  EXPECT_FALSE(rights.hold(""));
  ASSERT_TRUE(save_tokens(dir.str(), {kept("phone", "bbbb")}).has_value());
  EXPECT_FALSE(rights.hold(token_hash("aaaa")));
  EXPECT_TRUE(rights.hold(token_hash("bbbb")));
}

TEST(Rights, WithADamagedFileNoTokenHolds) {
  const testing::TempDir dir;
  Rights rights(dir.str());
  ASSERT_TRUE(save_tokens(dir.str(), {kept("desk", "aaaa")}).has_value());
  ASSERT_TRUE(rights.hold(token_hash("aaaa")));
  (void)std::remove(tokens_path(dir.str()).c_str());
  EXPECT_FALSE(rights.hold(token_hash("aaaa")));
  (void)dir.write("tokens", "x");
  EXPECT_FALSE(rights.hold(token_hash("aaaa")));
}

}  // namespace
}  // namespace topo::daemon
