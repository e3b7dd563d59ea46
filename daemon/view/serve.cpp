// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/serve.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <utility>

#include "daemon/view/feed.hpp"
#include "daemon/view/front.hpp"
#include "daemon/view/player.hpp"
#include "daemon/view/remake.hpp"

namespace topo::daemon {
namespace {

/// A live robot's page: all parts, in the order of dependency.
class View {
 public:
  explicit View(const Configuration& c)
      : front_(c, c.robot.name,
               [this](const std::string& method, const Json& params, OrderDesk::Done done) {
                 orders_line_.call(method, params, std::move(done));
               }),
        orders_line_(front_.io(), c.control.socket, {[] {}, [](const std::string&) {}, [](const Json&) {}}),
        feed_(front_.io(), c.control.socket, front_.board(), front_.rules()) {}

  types::Status run(const ViewConfig& view) {
    if (auto listening = front_.listen(view); !listening) return listening;
    orders_line_.start();
    feed_.start();
    front_.run();
    return {};
  }

 private:
  Front front_;
  ControlLine orders_line_;  ///< beside the feed's: no answer of that is before an order's
  Feed feed_;
};

void refuse(const std::string&, const Json&, const OrderDesk::Done& done) {
  done(types::fail(types::Errc::kUnsupported, "this is a replay: there is no robot behind this page"));
}

void tell_of(const Played& played) {
  spdlog::info("replay of {}: {} keyframes, {:.0f} s; {}", played.name, played.map.keyframes().size(),
               played.story.length_s(), played.log.empty() ? "no mission log beside it" : played.log);
  if (played.story.unread > 0)
    spdlog::warn("{}: {} lines are none of a mission log", played.log, played.story.unread);
}

/// Shows what a recording becomes, while a daemon plays it.
class Growing {
 public:
  Growing(boost::asio::io_context& io, Remake remake, Player& player)
      : remake_(std::move(remake)), player_(player), again_(io) {
    look();
  }

 private:
  void look() {
    const bool ended = !remake_.is_running();
    if (const auto session = find_session(remake_.folder())) {
      auto played = load_played(*session);
      if (played && ended) tell_of(*played);
      if (played) player_.load(std::move(*played), !ended);
    } else if (ended) {
      spdlog::error("{}: topometricd made no session of it; what it said is above", remake_.recording());
    }
    if (ended) return;
    again_.expires_after(std::chrono::seconds(2));
    again_.async_wait([this](const boost::system::error_code& cancelled) {
      if (!cancelled) look();
    });
  }

  Remake remake_;
  Player& player_;
  boost::asio::steady_timer again_;
};

}  // namespace

types::Status serve_view(const Configuration& configuration) {
  return View(configuration).run(configuration.view);
}

types::Status serve_replay(const Configuration& configuration, const std::string& file,
                           const std::string& path) {
  Front front(configuration, std::filesystem::path(path).stem().string(), &refuse);
  Player player(front.io(), {configuration.robot.name, configuration.mapping.grid}, front.board(),
                front.rules());
  front.set_time_line([&player](const Json& wish) { return player.take(wish); });
  std::unique_ptr<Growing> growing;
  if (is_recording(path)) {
    auto remake = Remake::start(file, path);
    if (!remake) return tl::unexpected(remake.error());
    growing = std::make_unique<Growing>(front.io(), std::move(*remake), player);
  } else {
    const auto session = find_session(path);
    if (!session) return tl::unexpected(session.error());
    auto played = load_played(*session);
    if (!played) return tl::unexpected(played.error());
    tell_of(*played);
    player.load(std::move(*played), false);
  }
  if (auto listening = front.listen(configuration.view); !listening) return listening;
  player.start();
  front.run();
  return {};
}

}  // namespace topo::daemon
