// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/front.hpp"

#include <spdlog/spdlog.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <utility>
#include <vector>

namespace topo::daemon {
namespace {

/// The names of this machine that no other site can have: its own, also as multicast DNS spells it, and those
/// of the configuration.
std::vector<std::string> own_names(const ViewConfig& view) {
  std::vector<std::string> names = view.hosts;
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name.front() == '\0') return names;
  names.emplace_back(name.data());
  names.push_back(names.back() + ".local");
  return names;
}

}  // namespace

Front::Front(const Configuration& configuration, const std::string& name, OrderDesk::Call call)
    : orders_(std::move(call)),
      rights_(configuration.view.state_folder),
      parts_{name, configuration.view.look, own_names(configuration.view), {}, board_, orders_, rights_, {}},
      server_(io_, parts_),
      ending_(io_, SIGTERM, SIGINT, SIGHUP),
      alive_(io_) {}

BoardRules Front::rules() {
  return {[this] { return server_.is_watched(); }, [this] { server_.tell_pages(); }};
}

types::Status Front::listen(const ViewConfig& view) {
  if (auto listening = server_.listen(view.address, view.port); !listening) return listening;
  const char* who = parts_.time_line                ? "who reaches it sees the replay"
                    : view.look == ViewLook::kToken ? "who has a token sees it"
                                                    : "who reaches it sees it, and may e-stop";
  spdlog::info("the page is at {} port {}; {}", view.address, server_.port(), who);
  return {};
}

void Front::run() {
  ending_.async_wait([this](const boost::system::error_code&, int) { io_.stop(); });
  ::sd_notify(0, "READY=1");
  tell_alive();
  io_.run();
  ::sd_notify(0, "STOPPING=1");
}

void Front::tell_alive() {
  ::sd_notify(0, "WATCHDOG=1");
  alive_.expires_after(std::chrono::seconds(1));
  alive_.async_wait([this](const boost::system::error_code& cancelled) {
    if (!cancelled) tell_alive();
  });
}

}  // namespace topo::daemon
