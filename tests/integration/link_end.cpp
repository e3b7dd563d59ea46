// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A daemon that does nothing but talk to its link, by the library that the daemon uses. Sends numbered
// datagrams, and prints ten times a second what it knows as one line of JSON, until its standard input ends.
// With a SEED the datagrams are noise of up to SIZE bytes, two of three behind the head of the team's
// exchange.
//
// usage: link_end SOCKET TEAM ROBOT PERIOD_MS SIZE [SEED]
#include <fmt/format.h>
#include <poll.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/team/exchange/wire.hpp"
#include "core/types/bytes.hpp"
#include "daemon/link/link_socket.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

struct Heard {
  std::uint64_t count = 0;
  std::uint32_t newest = 0;
};

std::string names_and_counts(const LinkStats& stats) {
  std::string text;
  for (std::size_t i = 0; i < kLinkDrops; ++i)
    text += fmt::format("{}\"{}\": {}", i == 0 ? "" : ", ", drop_name(static_cast<LinkDrop>(i)),
                        stats.dropped[i]);
  return text;
}

std::string status(const LinkSocket& socket, const std::vector<std::string>& news,
                   const std::map<int, Heard>& heard, std::uint64_t turns) {
  const LinkSocketCounts& c = socket.counts();
  const LinkStats s = socket.link().value_or(LinkStats{});
  std::string mates, told;
  for (const auto& [robot, h] : heard)
    mates += fmt::format("{}\"{}\": {}", mates.empty() ? "" : ", ", robot, h.count);
  for (const std::string& words : news) told += fmt::format("{}\"{}\"", told.empty() ? "" : ", ", words);
  return fmt::format(
      "{{\"joined\": {}, \"turns\": {}, \"heard\": {{{}}}, \"news\": [{}], \"sent\": {}, \"full\": {}, "
      "\"alone\": {}, "
      "\"radio\": {}, \"mates\": {}, \"radio_sent\": {}, \"dropped\": {{{}}}}}\n",
      socket.joined(), turns, mates, told, c.sent, c.dropped_full, c.dropped_alone, s.radio, s.mates, s.sent,
      names_and_counts(s));
}

/// What a robot of the team sends whose program has gone mad: bytes, a good head before bytes, and a good
/// head before messages of every kind with bytes in them.
class Noise {
 public:
  Noise(std::uint32_t seed, std::string_view team, std::uint16_t robot, std::size_t size)
      : random_(seed), head_{team::team_hash(team), {robot, seed}, 0}, size_(size) {}

  std::vector<std::byte> next() {
    ++head_.counter;
    if (draw(2) == 0) return bytes(1 + draw(size_ - 1));
    team::DatagramWriter writer(head_);
    if (draw(1) == 0) {
      std::vector<std::byte> datagram = writer.take();
      const auto rest = bytes(1 + draw(size_ - team::kHeadBytes - 1));
      datagram.insert(datagram.end(), rest.begin(), rest.end());
      return datagram;
    }
    for (auto body = bytes(draw(200)); writer.fits(body.size()); body = bytes(draw(200)))
      writer.add(static_cast<team::MessageKind>(draw(team::kMessageKinds)), body);
    return writer.take();
  }

 private:
  /// From 0 to `most`.
  std::size_t draw(std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random_); }
  std::vector<std::byte> bytes(std::size_t count) {
    std::vector<std::byte> made(count);
    for (std::byte& byte : made) byte = static_cast<std::byte>(draw(255));
    return made;
  }

  std::mt19937 random_;
  team::DatagramHead head_;
  std::size_t size_;
};

int run(const std::string& path, const LinkIdentity& own, types::Duration period, std::size_t size,
        std::optional<Noise> noise) {
  auto socket = LinkSocket::listen(path, own);
  if (!socket) {
    fmt::print(stderr, "{}\n", socket.error().message);
    return 1;
  }
  std::map<int, Heard> heard;
  std::vector<std::string> news;
  std::vector<std::byte> datagram(size);
  std::uint64_t turns = 0;
  std::uint32_t number = 0;
  types::Stamp next_send = io::monotonic_now(), next_status = next_send;
  for (;; ++turns) {
    std::array<pollfd, 2> entries{{{socket->fd(), POLLIN, 0}, {0, POLLIN, 0}}};
    ::poll(entries.data(), entries.size(), 2);
    if ((entries[1].revents & (POLLHUP | POLLIN)) != 0) return 0;
    const types::Stamp now = io::monotonic_now();
    const auto changed = socket->turn(now, [&heard](std::uint16_t sender, std::span<const std::byte> got) {
      if (got.size() < 6) return;
      Heard& mate = heard[sender];
      ++mate.count;
      mate.newest = types::load_le<std::uint32_t>(got, 2);
    });
    if (changed) {
      constexpr std::array<const char*, 3> kKinds{"joined", "alone", "refused"};
      news.emplace_back(kKinds[static_cast<std::size_t>(changed->kind)]);
      fmt::print(stderr, "link_end {}: {}: {}\n", own.robot, news.back(), changed->words);
    }
    if (now >= next_send) {
      next_send += period;
      if (noise) {
        datagram = noise->next();
      } else {
        types::store_le<std::uint16_t>(datagram, 0, own.robot);
        types::store_le<std::uint32_t>(datagram, 2, ++number);
      }
      static_cast<void>(socket->send(datagram));
    }
    if (now >= next_status) {
      next_status = now + 100ms;
      fmt::print("{}", status(*socket, news, heard, turns));
      if (std::fflush(stdout) != 0) return 0;
    }
  }
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) {
  using namespace topo::daemon;
  if (argc != 6 && argc != 7) {
    fmt::print(stderr, "usage: link_end SOCKET TEAM ROBOT PERIOD_MS SIZE [SEED]\n");
    return 2;
  }
  const LinkIdentity own{.team = team_hash(argv[2]),
                         .robot = static_cast<std::uint16_t>(std::atoi(argv[3])),
                         .version = kLinkVersion};
  const auto size = static_cast<std::size_t>(std::atoi(argv[5]));
  std::optional<Noise> noise;
  if (argc == 7) noise.emplace(static_cast<std::uint32_t>(std::atoi(argv[6])), argv[2], own.robot, size);
  return run(argv[1], own, std::chrono::milliseconds(std::atoi(argv[4])), size, std::move(noise));
}
