// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/set_ip.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <utility>

#include "drivers/hokuyo/identity.hpp"
#include "drivers/hokuyo/line.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using types::Errc;
using types::fail;

using Ipv4 = std::array<std::uint8_t, 4>;

constexpr types::Duration kOpenTime = 3s;
constexpr types::Duration kReplyTime = 2s;

std::uint32_t number(const Ipv4& a) {
  return static_cast<std::uint32_t>(a[0]) << 24U | static_cast<std::uint32_t>(a[1]) << 16U |
         static_cast<std::uint32_t>(a[2]) << 8U | a[3];
}

/// The two forms of an address that firmware takes: twelve digits, or with dots (PROTOCOLS section 10). One
/// that takes the other form refuses by the length.
std::string digits(const Ipv4& a, bool dots) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), dots ? "%03d.%03d.%03d.%03d" : "%03d%03d%03d%03d", a[0], a[1], a[2],
                a[3]);
  return text.data();
}

std::string request(const IpSettings& s, bool dots) {
  return "$IP" + digits(s.address, dots) + digits(s.netmask, dots) + digits(s.gateway, dots);
}

/// Sends and waits for the reply to just that request; what a scanner still sends of before is passed over.
types::Status ask(Line& line, const std::string& text, std::string_view where) {
  if (auto sent = line.send(text); !sent) return sent;
  for (const types::Stamp until = line.now() + kReplyTime; line.now() < until;) {
    const auto event = line.poll(until);
    if (!event) return tl::unexpected(event.error());
    if (*event == ScipParser::Event::kReply && line.reply().echo() == text) return {};
  }
  return fail(Errc::kTimeout, std::string(where) + ": no answer to " + text.substr(0, 3) +
                                  "; expected a Hokuyo sensor that no other program, topometricd among them, "
                                  "is connected to");
}

types::Result<SensorInfo> identify(Line& line, std::string_view where) {
  if (auto quit = ask(line, "QT", where); !quit) return tl::unexpected(quit.error());
  if (auto told = ask(line, "VV", where); !told) return tl::unexpected(told.error());
  SensorInfo info;
  if (auto read = read_version(line.reply(), info); !read) return tl::unexpected(read.error());
  return info;
}

types::Status check_serial(const SensorInfo& info, std::string_view expected, std::string_view where) {
  if (expected.empty() || same_serial(info.serial_number, expected)) return {};
  return fail(Errc::kInvalidInput, std::string(where) + ": found " + info.product + " " + info.serial_number +
                                       ", expected " + std::string(expected));
}

/// Models with an address of their own. Another's firmware is not tried (PROTOCOLS section 13: an unknown
/// command may hang it).
bool has_address(const SensorInfo& info) {
  const Family family = family_of(info.product);
  return family == Family::kUtmEw || family == Family::kUst;
}

types::Result<Line> open(io::Connector& connector, types::Duration limit) {
  const types::Stamp until = connector.now() + limit;
  for (;;) {
    auto stream = connector.connect(std::max<types::Duration>(until - connector.now(), 1ms));
    if (stream) {
      Line line;
      line.open(std::move(*stream));
      return line;
    }
    if (stream.error().code != Errc::kTimeout || connector.now() >= until)
      return tl::unexpected(stream.error());
  }
}

}  // namespace

types::Result<Ipv4> parse_ipv4(std::string_view text) {
  Ipv4 address{};
  const auto bad = [&] {
    return fail(Errc::kInvalidInput,
                "found \"" + std::string(text) + "\", expected an IPv4 address such as 192.168.0.11");
  };
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < address.size(); ++i) {
    int value = -1;
    const auto [stop, error] = std::from_chars(at, end, value);
    const bool last = i + 1 == address.size();
    if (error != std::errc{} || value < 0 || value > 255 ||
        (last ? stop != end : stop == end || *stop != '.'))
      return bad();
    address[i] = static_cast<std::uint8_t>(value);
    at = stop + 1;
  }
  return address;
}

std::string to_text(const Ipv4& a) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%d.%d.%d.%d", a[0], a[1], a[2], a[3]);
  return text.data();
}

types::Status check(const IpSettings& s) {
  const std::uint32_t mask = number(s.netmask), hosts = ~mask;
  if (mask == 0 || hosts < 3 || (hosts & (hosts + 1)) != 0)
    return fail(Errc::kInvalidInput, "netmask: found " + to_text(s.netmask) +
                                         ", expected ones and then two zeros or more, such as 255.255.255.0");
  const std::uint32_t host = number(s.address) & hosts;
  const int first = s.address[0];
  if (first == 0 || first == 127 || first >= 224 || host == 0 || host == hosts)
    return fail(Errc::kInvalidInput, "found " + to_text(s.address) +
                                         ", expected the address of one host in its network (netmask " +
                                         to_text(s.netmask) + ")");
  if ((number(s.gateway) & mask) != (number(s.address) & mask) || s.gateway == s.address)
    return fail(Errc::kInvalidInput, "gateway: found " + to_text(s.gateway) +
                                         ", expected another host in the network of " + to_text(s.address));
  return {};
}

types::Result<SensorInfo> set_ip(io::Connector& connector, const IpSettings& settings,
                                 std::string_view serial_number) {
  if (auto valid = check(settings); !valid) return tl::unexpected(valid.error());
  const std::string where(connector.name());
  auto line = open(connector, kOpenTime);
  if (!line) return tl::unexpected(line.error());
  auto info = identify(*line, where);
  if (!info) return info;
  if (auto expected = check_serial(*info, serial_number, where); !expected)
    return tl::unexpected(expected.error());
  if (!has_address(*info))
    return fail(Errc::kUnsupported,
                where + ": a " + info->product +
                    " has no network address that can be set; expected a UTM-30LX-EW or a "
                    "model of the UST series");
  for (const bool dots : {false, true}) {
    const std::string text = request(settings, dots);
    if (auto asked = ask(*line, text, where); !asked) return tl::unexpected(asked.error());
    if (line->reply().status() == "00") return info;
  }
  const std::string status(line->reply().status());
  return fail(Errc::kUnsupported, where + ": " + info->product + " " + info->serial_number + " (firmware " +
                                      info->firmware + ") refuses $IP with status " + status + ", " +
                                      std::string(describe_status(status)) +
                                      ": it keeps its address; use the maker's tool");
}

types::Status await_sensor(io::Connector& connector, std::string_view serial_number,
                           types::Duration patience) {
  constexpr types::Duration kBetween = 500ms;
  const std::string where(connector.name());
  std::string last = "nothing answered";
  for (const types::Stamp until = connector.now() + patience; connector.now() < until;
       connector.pause(kBetween)) {
    auto line = open(connector, 1s);
    if (!line) continue;
    const auto info = identify(*line, where);
    if (info) return check_serial(*info, serial_number, where);
    last = info.error().message;
  }
  return fail(Errc::kTimeout,
              where + ": the scanner " + std::string(serial_number) + " is not there (" + last +
                  "): was its power switched off and on, and is this computer in its network?");
}

}  // namespace topo::hokuyo
