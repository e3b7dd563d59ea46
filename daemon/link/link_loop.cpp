// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/link_loop.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/signalfd.h>
#include <systemd/sd-daemon.h>

#include <array>
#include <cerrno>
#include <charconv>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// A turn at least this often: statistics, the watchdog, a radio that hangs.
constexpr int kTurn_ms = 200;

}  // namespace

std::string carried_text(const Carried& carried) {
  std::string text = fmt::format("{}{}:", carried.quiet ? "q" : "", carried.daemon_fd);
  for (const std::byte b : encode_stats(carried.stats))
    text += fmt::format("{:02x}", std::to_integer<unsigned>(b));
  return text;
}

Carried parse_carried(const std::string& text) {
  Carried carried;
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {};
  carried.quiet = text.starts_with('q');
  const char* const number = text.data() + (carried.quiet ? 1 : 0);
  const char* const end = text.data() + text.size();
  if (std::from_chars(number, text.data() + colon, carried.daemon_fd).ptr != text.data() + colon) return {};
  std::vector<std::byte> bytes;
  for (const char* at = text.data() + colon + 1; at + 2 <= end; at += 2) {
    unsigned value = 0;
    if (std::from_chars(at, at + 2, value, 16).ptr != at + 2) return {};
    bytes.push_back(static_cast<std::byte>(value));
  }
  const auto stats = decode_stats(bytes);
  if (!stats) return {};
  carried.stats = *stats;
  return carried;
}

LinkLoop::LinkLoop(const TeamConfig& team, const Carried& carried, NetworkWatch network, io::UniqueFd signals,
                   const LinkLoopParams& params)
    : team_(team),
      params_(params),
      identity_{team_hash(team.name), static_cast<std::uint16_t>(team.id), kLinkVersion},
      network_(std::move(network)),
      signals_(std::move(signals)),
      line_(team.socket, identity_, carried.daemon_fd),
      address_(network_address(team.interface)),
      came_quiet_(carried.quiet),
      own_(carried.stats) {
  failed_at_ = types::Stamp{} - params_.try_again;
}

types::Result<std::unique_ptr<LinkLoop>> LinkLoop::make(const TeamConfig& team, const Carried& carried,
                                                        const LinkLoopParams& params) {
  auto network = NetworkWatch::open();
  if (!network) return tl::unexpected(network.error());
  sigset_t ending;
  ::sigemptyset(&ending);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::sigaddset(&ending, signal);
  io::UniqueFd signals(::signalfd(-1, &ending, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!signals.valid()) return io::fail_errno("topolink", "no signals", errno);
  return std::unique_ptr<LinkLoop>(
      new LinkLoop(team, carried, std::move(*network), std::move(signals), params));
}

void LinkLoop::wait() {
  std::array<pollfd, 4> entries{{{signals_.get(), POLLIN, 0},
                                 {network_.fd(), POLLIN, 0},
                                 {line_.fd(), POLLIN, 0},
                                 {radio_ ? radio_->shared().arrived.fd() : -1, POLLIN, 0}}};
  ::poll(entries.data(), entries.size(), kTurn_ms);
  if (radio_ && (entries[3].revents & POLLIN) != 0)
    static_cast<void>(radio_->shared().arrived.wait(types::Duration::zero()));
}

bool LinkLoop::stopped() const {
  signalfd_siginfo info{};
  return ::read(signals_.get(), &info, sizeof info) == sizeof info;
}

/// Whether a handshake may have been left half done: with credentials, and no mate for long.
bool LinkLoop::lonely(types::Stamp now) {
  const bool up = radio_ && address_ && radio_->shared().up.load(std::memory_order_acquire);
  if (!team_.secure() || !up || radio_->shared().mates.load(std::memory_order_relaxed) > 0) {
    lonely_since_.reset();
    return false;
  }
  if (!lonely_since_) lonely_since_ = now;
  // The spread keeps two robots from beginning anew together: any number that they do not share will do.
  const types::Duration chance = lonely_since_->time_since_epoch() % params_.lonely_spread;
  return now - *lonely_since_ > params_.lonely + chance;
}

/// The participant keeps the interface that it was made with: another address, an interface that was down or
/// gone, and a call that does not return are all cured by another participant.
bool LinkLoop::must_begin_anew(types::Stamp now) {
  if (network_.drain()) address_ = network_address(team_.interface);
  if (!radio_) return false;
  if (address_ != made_for_) {
    if (address_) {
      spdlog::info("{} is back or has another address: the radio is made anew", team_.interface);
      return true;
    }
    if (!std::exchange(told_waiting_, true))
      spdlog::warn("{} is gone or down: waiting for it", team_.interface);
    made_for_.reset();  // the same address again is another beginning
    return false;
  }
  if (address_ && radio_->busy(now) > params_.hang) {
    spdlog::error("DDS has not returned from a call for {} s: the radio is made anew",
                  types::to_seconds(params_.hang));
    return true;
  }
  quiet_ = lonely(now);
  return quiet_;
}

void LinkLoop::start_radio(types::Stamp now) {
  if (radio_ || now - failed_at_ < params_.try_again) return;
  if (!address_) {
    if (!std::exchange(told_waiting_, true))
      spdlog::warn("{} is absent, down or without an IPv4 address: waiting for it", team_.interface);
    return;
  }
  RadioPlan plan{team_.interface,
                 address_->address,
                 address_->multicast,
                 team_.peers,
                 static_cast<std::uint32_t>(team_.domain),
                 identity_.team,
                 identity_.robot,
                 team_.secure() ? team_.security : std::string()};
  radio_ = std::make_unique<Radio>(std::move(plan), identity_);
  made_for_ = address_;
  radio_->start();
}

void LinkLoop::watch_radio() {
  if (!radio_) return;
  if (radio_->shared().up.load(std::memory_order_acquire) && !std::exchange(told_up_, true))
    spdlog::log(came_quiet_ ? spdlog::level::debug : spdlog::level::info,
                "the radio is up on {} ({}), team {}, robot {}, domain {}, {}, security {}", team_.interface,
                made_for_ ? made_for_->address : "", team_.name, team_.id, team_.domain,
                team_.peers.empty() ? "multicast" : fmt::format("{} peers", team_.peers.size()),
                team_.security);
}

void LinkLoop::to_radio(std::span<const std::byte> datagram) {
  if (!radio_ || !address_ || !radio_->shared().up.load(std::memory_order_acquire))
    return count(LinkDrop::kNoRadio);
  if (!radio_->send(datagram)) count(LinkDrop::kRadioFull);
}

void LinkLoop::from_radio() {
  if (!radio_) return;
  auto& in = radio_->shared().in;
  for (std::size_t n = 0; n < RadioRing::capacity(); ++n) {
    const RadioSlot* slot = in.front();
    if (slot == nullptr) return;
    switch (line_.send(slot->robot, slot->content())) {
      case LinkChannel::Sent::kYes:
        ++own_.received;
        own_.received_bytes += slot->size;
        break;
      case LinkChannel::Sent::kFull:
        count(LinkDrop::kDaemonFull);
        break;
      case LinkChannel::Sent::kClosed:
        count(LinkDrop::kNoDaemon);
        break;
    }
    in.pop();
  }
}

void LinkLoop::exchange(types::Stamp now) {
  const auto said = line_.turn(
      now, [this](std::span<const std::byte> datagram) { to_radio(datagram); },
      own_.dropped[static_cast<std::size_t>(LinkDrop::kWrongSize)]);
  if (said) spdlog::info("{}", *said);
  from_radio();
}

LinkStats LinkLoop::stats() const {
  LinkStats all = own_;
  all.radio = false;
  all.mates = 0;
  if (!radio_) return all;
  const Radio::Shared& shared = radio_->shared();
  all.radio = address_.has_value() && shared.up.load(std::memory_order_acquire);
  all.mates = all.radio ? shared.mates.load(std::memory_order_relaxed) : std::uint16_t{0};
  all.sent += shared.sent.load(std::memory_order_relaxed);
  all.sent_bytes += shared.sent_bytes.load(std::memory_order_relaxed);
  for (std::size_t i = 0; i < kLinkDrops; ++i)
    all.dropped[i] += shared.dropped[i].load(std::memory_order_relaxed);
  return all;
}

void LinkLoop::tell_manager(const char* state) { static_cast<void>(::sd_notify(0, state)); }

void LinkLoop::report(types::Stamp now) {
  if (now < next_stats_) return;
  next_stats_ = now + params_.stats_period;
  const LinkStats all = stats();
  line_.send_stats(all);
  if (const auto line = drops_.line(now, all)) spdlog::warn("{}", *line);
  tell_manager(fmt::format("WATCHDOG=1\nSTATUS={}, {} mates, {} sent, {} received",
                           all.radio ? "radio up" : "no radio", all.mates, all.sent, all.received)
                   .c_str());
}

LinkLoop::End LinkLoop::run() {
  tell_manager("READY=1");
  for (;;) {
    const types::Stamp now = io::monotonic_now();
    if (must_begin_anew(now)) return End::kAnew;
    if (radio_ && radio_->shared().failed.load(std::memory_order_acquire)) {
      if (std::exchange(told_failure_, radio_->shared().failure) != radio_->shared().failure)
        spdlog::error("the radio cannot be made, trying again every {} s: {}",
                      types::to_seconds(params_.try_again), told_failure_);
      radio_.reset();
      failed_at_ = now;
    }
    start_radio(now);
    watch_radio();
    exchange(now);
    report(now);
    wait();
    if (stopped()) break;
  }
  tell_manager("STOPPING=1");
  constexpr types::Duration kPatience = std::chrono::seconds(1);
  if (radio_ && !radio_->end(kPatience)) spdlog::warn("DDS does not end; the process ends without it");
  return End::kStopped;
}

Carried LinkLoop::carried() {
  const int fd = line_.joined() ? ::fcntl(line_.fd(), F_DUPFD, 3) : -1;  // without close-on-exec
  return {fd, stats(), quiet_};
}

}  // namespace topo::daemon
