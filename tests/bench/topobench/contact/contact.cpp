// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/contact/contact.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <random>

#include "core/slam/keyframe_codec.hpp"
#include "core/types/invariant.hpp"
#include "tests/bench/topobench/stopwatch.hpp"

namespace topo::bench {
namespace {

using team::Exchange;

constexpr types::Duration kStep = std::chrono::milliseconds(25);
constexpr double kHitBytes = 2.0;  // encoded: steps of at most 55 mm in two axes

/// Of random content, which no compression makes smaller than it is.
slam::Keyframe random_keyframe(const slam::KeyframeId& id, std::size_t bytes, std::mt19937_64& random) {
  std::uniform_real_distribution<float> step(-0.055F, 0.055F), place(-12.0F, 12.0F);
  slam::Keyframe keyframe;
  keyframe.id = id;
  keyframe.stamp = types::stamp_from_seconds(0.6 * id.sequence);
  keyframe.T_odom_base = {static_cast<double>(place(random)), 0.0, 0.0};
  const double share = std::uniform_real_distribution<double>(0.8, 1.2)(random);
  const auto hits = static_cast<std::size_t>(share * static_cast<double>(bytes) / kHitBytes);
  slam::Point at(place(random), place(random));
  slam::KeyframeContent content;
  for (std::size_t i = 0; i < hits; ++i) {
    at += slam::Point(step(random), step(random));
    content.hits.push_back(at);
  }
  keyframe.content = slam::CodedContent(std::move(content));
  return keyframe;
}

/// A robot with what it makes.
struct Member {
  Exchange exchange;
  std::mt19937_64 random;
  std::uint32_t made = 0, found = 0;
};

class Contact {
 public:
  explicit Contact(const ContactSetup& setup) : setup_(setup), radio_(setup.seed) {
    for (std::uint16_t robot = 0; robot < setup.robots; ++robot) {
      team::ExchangeParams params;
      params.rates = setup.rates;
      params.periods.seed = setup.seed * 1'000 + robot;
      members_.push_back({Exchange({team::team_hash("contact"), robot, 1}, params),
                          std::mt19937_64(setup.seed * 77 + robot)});
    }
  }

  ContactResult run() {
    const double begun_s = cpu_seconds();
    for (Member& member : members_) {
      while (member.made < setup_.keyframes) make(member);
    }
    catch_up();
    if (result_.same_sets) steady();
    result_.cpu_s = cpu_seconds() - begun_s;
    return result_;
  }

 private:
  struct Sent {
    types::Stamp due;
    std::size_t to;
    std::shared_ptr<const team::Datagram> datagram;
  };

  /// A keyframe, the relation to the one before, and with some a closure.
  void make(Member& member) {
    const auto [hash, robot, run] = member.exchange.identity();
    const std::uint32_t n = member.made++;
    const auto must = [](const types::Status& status) {
      types::require(status.has_value(), "contact: an own item");
    };
    must(
        member.exchange.add_keyframe(random_keyframe({robot, n, run}, setup_.keyframe_bytes, member.random)));
    if (n == 0) return;
    slam::FoundRelation found;
    found.relation.T_from_to = {0.4, 0.001 * n, 0.01};
    const auto relate = [&](std::uint32_t from) {
      found.id = {robot, member.found++, run};
      found.key = {{robot, from, run}, {robot, n, run}};
      must(member.exchange.add_relation(found));
    };
    relate(n - 1);
    if (n % 2 == 0) relate(n / 2);
  }

  void step() {
    now_ += kStep;
    for (; !sent_.empty() && sent_.front().due <= now_; sent_.pop_front())
      members_[sent_.front().to].exchange.take(*sent_.front().datagram, now_);
    for (std::size_t from = 0; from < members_.size(); ++from) {
      for (team::Datagram& datagram : members_[from].exchange.datagrams(now_)) {
        const auto shared = std::make_shared<const team::Datagram>(std::move(datagram));
        for (std::size_t to = 0; to < members_.size(); ++to) {
          const bool lost = std::uniform_real_distribution<double>(0.0, 1.0)(radio_) < setup_.loss;
          if (to != from && !lost) sent_.push_back({now_ + types::from_seconds(setup_.delay_s), to, shared});
        }
      }
      (void)members_[from].exchange.take_news(now_);
      result_.assembly_bytes_max =
          std::max(result_.assembly_bytes_max, members_[from].exchange.assembly_bytes());
    }
  }

  [[nodiscard]] bool are_same() const {
    return std::ranges::all_of(members_, [&](const Member& member) {
      return member.exchange.items().hash() == members_.front().exchange.items().hash();
    });
  }

  [[nodiscard]] std::uint64_t sent_bytes() const {
    std::uint64_t sum = 0;
    for (const Member& member : members_) sum += member.exchange.counters().sent_bytes;
    return sum;
  }

  [[nodiscard]] std::size_t held() const {
    std::size_t sum = 0;
    for (const Member& member : members_) sum += member.exchange.items().size();
    return sum;
  }

  void catch_up() {
    const types::Stamp begin = now_;
    const double own = static_cast<double>(held()), lacking = own * static_cast<double>(members_.size() - 1);
    std::size_t share = 0;
    while (!are_same() && types::to_seconds(now_ - begin) < setup_.limit_s) {
      step();
      for (constexpr std::array<double, 3> kShares{0.1, 0.5, 0.9};
           share < kShares.size() && static_cast<double>(held()) >= own + kShares.at(share) * lacking;
           ++share)
        result_.shares_s.at(share) = types::to_seconds(now_ - begin);
    }
    result_.same_sets = are_same();
    result_.same_after_s = types::to_seconds(now_ - begin);
    result_.catch_up_bytes_per_s =
        static_cast<double>(sent_bytes()) / static_cast<double>(members_.size()) / result_.same_after_s;
    double repeated = 0.0, received = 0.0;
    for (const Member& member : members_) {
      repeated += static_cast<double>(member.exchange.counters().repeated);
      received += static_cast<double>(member.exchange.counters().received);
    }
    result_.repeated = repeated / received;
  }

  /// All have all, and go on.
  void steady() {
    for (int i = 0; i < 400; ++i) step();  // the rates fall back
    const auto before = counters();
    const types::Stamp begin = now_, end = begin + types::from_seconds(setup_.steady_s);
    types::Stamp made = begin;
    while (now_ < end) {
      if (types::to_seconds(now_ - made) >= 1.0 / setup_.keyframes_hz) {
        for (Member& member : members_) {
          make(member);
          member.exchange.say(status());
        }
        made += types::from_seconds(1.0 / setup_.keyframes_hz);
      }
      step();
      note_lag();
    }
    const auto after = counters();
    const double robots_s = static_cast<double>(members_.size()) * setup_.steady_s;
    result_.steady_bytes_per_s = static_cast<double>(after.second - before.second) / robots_s;
    for (std::size_t kind = 0; kind < team::kMessageKinds; ++kind)
      result_.steady_bytes_per_s_of.at(kind) =
          static_cast<double>(after.first.at(kind) - before.first.at(kind)) / robots_s;
  }

  /// How far the slowest robot is behind: its items of each mate, at the rate at which they are made.
  void note_lag() {
    for (const Member& origin : members_) {
      const auto [hash, robot, run] = origin.exchange.identity();
      for (const Member& member : members_) {
        const auto* stream = member.exchange.items().stream({team::ItemKind::kKeyframe, {robot, run}});
        const double behind = static_cast<double>(origin.made) - static_cast<double>(stream->first_gap());
        result_.steady_lag_s = std::max(result_.steady_lag_s, behind / setup_.keyframes_hz);
      }
    }
  }

  [[nodiscard]] std::pair<std::array<std::uint64_t, team::kMessageKinds>, std::uint64_t> counters() const {
    std::pair<std::array<std::uint64_t, team::kMessageKinds>, std::uint64_t> sum{};
    for (const Member& member : members_) {
      const team::ExchangeCounters& counted = member.exchange.counters();
      for (std::size_t kind = 0; kind < team::kMessageKinds; ++kind)
        sum.first.at(kind) += counted.sent_bytes_of.at(kind);
      sum.second += counted.sent_bytes;
    }
    return sum;
  }

  /// As of a robot amid an exploration: a claim, a dozen goals and the next six metres.
  static team::StatusMessage status() {
    team::StatusMessage status;
    status.duty = team::Duty::kAble;
    status.claim = team::Bid{{3.0, 4.0}, 7.5, true};
    for (int i = 0; i < 12; ++i) status.bids.push_back({{2.5 * i, 10.0 - i}, 5.0 + i, i % 3 != 0});
    for (int i = 0; i < 20; ++i) status.way_map.emplace_back(0.3 * i, 0.1 * i);
    return status;
  }

  const ContactSetup& setup_;
  std::mt19937_64 radio_;
  std::vector<Member> members_;
  std::deque<Sent> sent_;
  types::Stamp now_ = types::stamp_from_seconds(3'600.0);
  ContactResult result_;
};

}  // namespace

ContactResult run_contact(const ContactSetup& setup) { return Contact(setup).run(); }

}  // namespace topo::bench
