// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <set>

#include "daemon/view/http_session.hpp"
#include "daemon/view/page.hpp"

namespace topo::daemon {
namespace {

namespace http = boost::beast::http;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

HttpRequest request(const std::string& target, const std::string& host = "127.0.0.1:8080") {
  HttpRequest made(http::verb::get, target, 11);
  made.set(http::field::host, host);
  return made;
}

HttpResponse answer(const HttpRequest& asked) { return answer_request(asked, {"robot1"}); }

template <class Name>
std::string header(const HttpResponse& response, Name name) {
  return std::string(response[name]);
}

TEST(AnswerRequest, ThePageComesWithItsPolicy) {
  const HttpResponse page = answer(request("/"));
  EXPECT_EQ(page.result(), http::status::ok);
  EXPECT_EQ(header(page, http::field::content_type), "text/html; charset=utf-8");
  EXPECT_THAT(page.body(), HasSubstr("E-STOP ALL"));
  const std::string policy = header(page, "Content-Security-Policy");
  EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
  EXPECT_THAT(policy, HasSubstr("script-src 'self'"));
  EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
}

TEST(AnswerRequest, EveryFileOfThePageIsThere) {
  std::set<std::string_view> names;
  for (const PageFile& file : page_files()) {
    names.insert(file.name);
    const HttpResponse got = answer(request("/" + std::string(file.name) + "?1"));
    EXPECT_EQ(got.result(), http::status::ok) << file.name;
    EXPECT_EQ(got.body(), file.bytes) << file.name;
    EXPECT_NE(header(got, http::field::content_type), "application/octet-stream") << file.name;
  }
  EXPECT_TRUE(names.contains("main.js"));
}

TEST(AnswerRequest, ThePageHasNoScriptOrStyleInIt) {
  for (const PageFile& file : page_files()) {
    if (!file.name.ends_with(".html")) continue;
    EXPECT_THAT(std::string(file.bytes), Not(HasSubstr("style=")));
    EXPECT_THAT(std::string(file.bytes), Not(ContainsRegex("[ \n]on[a-z]+="))) << "no handlers";
    EXPECT_THAT(std::string(file.bytes), Not(HasSubstr("://")));
  }
}

TEST(AnswerRequest, PackedWhereTheBrowserTakesIt) {
  HttpRequest asked = request("/main.js");
  asked.set(http::field::accept_encoding, "br, gzip");
  const HttpResponse packed = answer(asked);
  EXPECT_EQ(header(packed, http::field::content_encoding), "gzip");
  EXPECT_EQ(packed.body().substr(0, 2), "\x1f\x8b");
  EXPECT_LT(packed.body().size(), answer(request("/main.js")).body().size());
}

TEST(AnswerRequest, AHeadHasTheLengthAlone) {
  HttpRequest asked = request("/");
  asked.method(http::verb::head);
  const HttpResponse head = answer(asked);
  EXPECT_TRUE(head.body().empty());
  EXPECT_EQ(header(head, http::field::content_length), std::to_string(answer(request("/")).body().size()));
}

TEST(AnswerRequest, NoOtherFileIsReached) {
  for (const char* target :
       {"/../tokens", "//etc/passwd", "/index.html/", "/%2e%2e/tokens", "index.html", "/x", "*"})
    EXPECT_EQ(answer(request(target)).result(), http::status::not_found) << target;
  HttpRequest post = request("/");
  post.method(http::verb::post);
  EXPECT_EQ(answer(post).result(), http::status::method_not_allowed);
}

TEST(AnswerRequest, AForeignHostGetsNothing) {
  for (const char* host : {"evil.example", "robot1.evil.example:8080", ""}) {
    const HttpResponse refused = answer(request("/", host));
    EXPECT_EQ(refused.result(), http::status::forbidden) << host;
    EXPECT_THAT(refused.body(), Not(HasSubstr("E-STOP")));
  }
  HttpRequest twice = request("/");
  twice.insert(http::field::host, "evil.example");
  EXPECT_EQ(answer(twice).result(), http::status::forbidden);
}

TEST(AnswerRequest, AForeignOriginGetsNothing) {
  HttpRequest foreign = request("/");
  foreign.set(http::field::origin, "http://evil.example");
  EXPECT_EQ(answer(foreign).result(), http::status::forbidden);
  foreign.set(http::field::origin, "http://127.0.0.1:8080");
  EXPECT_EQ(answer(foreign).result(), http::status::ok);
  foreign.insert(http::field::origin, "http://evil.example");
  EXPECT_EQ(answer(foreign).result(), http::status::forbidden);
}

}  // namespace
}  // namespace topo::daemon
