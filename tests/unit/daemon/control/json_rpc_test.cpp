// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/json_rpc.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "daemon/control/line_buffer.hpp"

namespace topo::daemon {
namespace {

RpcCode code_of(std::string_view line) {
  const auto request = parse_request(line);
  EXPECT_FALSE(request.has_value()) << line;
  return request ? RpcCode::kInternalError : request.error().code;
}

TEST(JsonRpc, TakesARequest) {
  const auto request = parse_request(
      R"({"jsonrpc": "2.0", "method": "drive", "params": {"v_mps": 0.5, "omega_radps": 0}, "id": 7})");
  ASSERT_TRUE(request.has_value());
  EXPECT_EQ(request->method, "drive");
  EXPECT_EQ(request->id, 7);
  EXPECT_FALSE(request->notify);
  EXPECT_EQ(*real_param(request->params, "v_mps"), 0.5);
  EXPECT_EQ(*real_param(request->params, "omega_radps"), 0.0);
}

TEST(JsonRpc, WithoutIdNoAnswerIsWanted) {
  const auto request = parse_request(R"({"jsonrpc": "2.0", "method": "estop"})");
  ASSERT_TRUE(request.has_value());
  EXPECT_TRUE(request->notify);
}

TEST(JsonRpc, RefusesWhatIsNoRequest) {
  EXPECT_EQ(code_of("{"), RpcCode::kParseError);
  EXPECT_EQ(code_of("[]"), RpcCode::kInvalidRequest);  // no batches
  EXPECT_EQ(code_of("3"), RpcCode::kInvalidRequest);
  EXPECT_EQ(code_of(R"({"method": "status", "id": 1})"), RpcCode::kInvalidRequest);
  EXPECT_EQ(code_of(R"({"jsonrpc": "1.0", "method": "status", "id": 1})"), RpcCode::kInvalidRequest);
  EXPECT_EQ(code_of(R"({"jsonrpc": "2.0", "method": 3, "id": 1})"), RpcCode::kInvalidRequest);
  EXPECT_EQ(code_of(R"({"jsonrpc": "2.0", "method": "status", "params": [1], "id": 1})"),
            RpcCode::kInvalidRequest);
  EXPECT_EQ(code_of(R"({"jsonrpc": "2.0", "method": "status", "id": {}})"), RpcCode::kInvalidRequest);
  EXPECT_EQ(code_of("{\"jsonrpc\": \"2.0\", \"method\": \"\xff\", \"id\": 1}"), RpcCode::kParseError);
}

TEST(JsonRpc, LimitsDepthAndLength) {
  EXPECT_EQ(code_of(std::string(10000, '[')), RpcCode::kInvalidRequest);
  EXPECT_EQ(code_of(std::string(kMaxRequestBytes + 1, ' ')), RpcCode::kInvalidRequest);
  // Brackets inside a string are no nesting.
  EXPECT_TRUE(parse_request(R"({"jsonrpc": "2.0", "method": "[[[[[[[[[[\"[[[[[["})").has_value());
}

TEST(JsonRpc, NumbersBeyondAnyMapAreRefused) {
  const Json params{{"x_m", -1e300}, {"y_m", 100000.5}, {"z_m", -1e5}, {"n", std::nan("")}};
  EXPECT_EQ(real_param(params, "x_m").error().message,
            "x_m: found -1e+300, expected a number from -100000 to 100000");
  EXPECT_EQ(real_param(params, "y_m").error().code, RpcCode::kInvalidParams);
  EXPECT_FALSE(real_param(params, "n"));
  EXPECT_EQ(real_param(params, "z_m"), -1e5);
}

TEST(JsonRpc, ParametersSayWhatWasFound) {
  const Json params{{"v_mps", "fast"}, {"x", 1}};
  EXPECT_EQ(real_param(params, "v_mps").error().message,
            "v_mps: found \"fast\", expected a number from -100000 to 100000");
  EXPECT_EQ(real_param(params, "omega_radps").error().message, "omega_radps is missing, expected a number");
  EXPECT_EQ(text_param(params, "x").error().message, "x: found 1, expected a string");
  ASSERT_TRUE(only_params(params, {"v_mps"}).has_value());
  EXPECT_EQ(only_params(params, {"v_mps"})->message, "unknown parameter \"x\"");
  EXPECT_FALSE(only_params(params, {"v_mps", "x"}).has_value());
}

TEST(JsonRpc, AnswersReadBack) {
  const auto result = parse_answer(result_line(3, Json{{"a", 1}}), 3);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ((*result)["a"], 1);
  EXPECT_EQ(parse_answer(result_line(3, 1), 4).error().code, types::Errc::kProtocol);
  const auto forbidden = parse_answer(error_line(3, {RpcCode::kForbidden, "no"}), 3);
  EXPECT_EQ(forbidden.error().code, types::Errc::kPermission);
  EXPECT_EQ(forbidden.error().message, "no");
  EXPECT_EQ(parse_answer("nonsense", 1).error().code, types::Errc::kProtocol);
  EXPECT_EQ(parse_answer(R"({"error": {}})", 1).error().code, types::Errc::kProtocol);
}

TEST(JsonRpc, RequestsReadBack) {
  EXPECT_TRUE(rc::check("any method, parameter and id", [](const std::string& text, int id) {
    // Text that is no UTF-8 is replaced on the way out, never thrown.
    const auto request = parse_request(request_line("m", Json{{"p", text.substr(0, 1000)}}, id));
    RC_ASSERT(request.has_value());
    RC_ASSERT(request->id == id);
    RC_ASSERT(text_param(request->params, "p").has_value());
  }));
}

TEST(JsonRpc, AnyBytesAreParsedOrRefused) {
  EXPECT_TRUE(rc::check("any bytes", [](const std::string& line) {
    const auto request = parse_request(line);
    RC_ASSERT(request.has_value() || !request.error().message.empty());
    RC_ASSERT(!parse_answer(line, 1).has_value());
  }));
  const std::string good =
      R"({"jsonrpc": "2.0", "method": "drive", "params": {"v_mps": 0.5, "omega_radps": -1e3}, "id": "x"})";
  EXPECT_TRUE(rc::check("mutations", [&good] {
    std::string line = good;
    for (int i = *rc::gen::inRange(1, 5); i > 0; --i) {
      line[*rc::gen::inRange<std::size_t>(0, line.size())] = *rc::gen::arbitrary<char>();
    }
    const auto request = parse_request(line);
    if (request) {
      RC_ASSERT(request->params.is_object());
    } else {
      RC_ASSERT(!request.error().message.empty());
    }
  }));
}

TEST(LineBuffer, CutsAnyStreamAtItsLineFeeds) {
  EXPECT_TRUE(rc::check("however it is cut into pieces", [](const std::vector<std::string>& pieces) {
    LineBuffer buffer(1 << 20);
    std::string all, lines;
    for (const auto& piece : pieces) {
      all += piece;
      RC_ASSERT(buffer.append(piece));
      while (const auto line = buffer.take_line()) lines += *line + "\n";
    }
    std::string expected = all.substr(0, all.rfind('\n') + 1);
    for (auto at = expected.find("\r\n"); at != std::string::npos; at = expected.find("\r\n", at))
      expected.erase(at, 1);
    RC_PRE(all.find("\r\r\n") == std::string::npos);
    RC_ASSERT(lines == expected);
  }));
  LineBuffer small(4);
  EXPECT_TRUE(small.append("1234"));
  EXPECT_FALSE(small.append("5"));
}

TEST(JsonRpc, EstopIsRecognisedHoweverItIsSpelt) {
  EXPECT_TRUE(is_estop(R"({"jsonrpc":"2.0","method":"estop","id":1})"));
  EXPECT_TRUE(is_estop(R"({"jsonrpc":"2.0","method":"e\u0073top"})"));
  EXPECT_FALSE(is_estop(R"({"jsonrpc":"2.0","method":"clear_estop","id":1})"));
  EXPECT_FALSE(is_estop(R"({"jsonrpc":"2.0","method":"status","id":"estop"})"));
  EXPECT_FALSE(is_estop("estop"));
}

TEST(JsonRpc, PreparedLineIsTheResultLine) {
  const Json result{{"places", {1, 2, 3}}, {"name", "\xff"}};
  EXPECT_EQ(prepared_line("a\nb", result_text(result)), result_line("a\nb", result));
}

}  // namespace
}  // namespace topo::daemon
