// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/view_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/ip/v6_only.hpp>
#include <utility>

namespace topo::daemon {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using types::Errc;
using types::fail;
using types::Status;

// No descriptor is free: those that close make one.
constexpr auto kAcceptAgain = std::chrono::milliseconds(200);

}  // namespace

ViewServer::ViewServer(asio::io_context& io, ViewParts& parts)
    : parts_(parts),
      acceptor_(io),
      again_(io),
      seats_(std::make_shared<std::map<std::string, std::size_t>>()) {}

Status ViewServer::listen(const std::string& address, int port) {
  error_code failed;
  const auto ip = asio::ip::make_address(address, failed);
  if (failed)
    return fail(Errc::kInvalidInput,
                fmt::format("view.address: found \"{}\", expected an IP address", address));
  const tcp::endpoint here(ip, static_cast<std::uint16_t>(port));
  acceptor_.open(here.protocol(), failed);
  if (!failed) acceptor_.set_option(tcp::acceptor::reuse_address(true), failed);
  if (!failed && ip.is_v6()) acceptor_.set_option(asio::ip::v6_only(false), failed);
  if (!failed) acceptor_.bind(here, failed);
  if (!failed) acceptor_.listen(asio::socket_base::max_listen_connections, failed);
  if (failed)
    return fail(Errc::kIo, fmt::format("cannot listen on {} port {}: {}", address, port, failed.message()));
  accept();
  return {};
}

int ViewServer::port() const {
  error_code ignored;
  return acceptor_.local_endpoint(ignored).port();
}

void ViewServer::accept() {
  acceptor_.async_accept([this](const error_code& failed, tcp::socket socket) {
    if (failed == asio::error::operation_aborted) return;
    if (!failed) {
      take_in(std::move(socket));
      return accept();
    }
    again_.expires_after(kAcceptAgain);
    again_.async_wait([this](const error_code& cancelled) {
      if (!cancelled) accept();
    });
  });
}

void ViewServer::take_in(tcp::socket socket) {
  auto seat = seat_for(socket);
  if (seat == nullptr) return;  // closed
  std::make_shared<HttpSession>(
      boost::beast::tcp_stream(std::move(socket)), parts_, std::move(seat),
      [this](boost::beast::tcp_stream&& stream, const HttpRequest& request,
             const std::shared_ptr<void>& taken) { return take_page(std::move(stream), request, taken); })
      ->start();
}

/// Null when there are connections enough, in all or from this address.
std::shared_ptr<void> ViewServer::seat_for(const tcp::socket& socket) {
  error_code failed;
  const auto peer = socket.remote_endpoint(failed);
  if (failed) return nullptr;
  const std::string address = peer.address().to_string();
  std::size_t all = 0;
  for (const auto& [from, connections] : *seats_) all += connections;
  const auto found = seats_->find(address);
  const std::size_t of_it = found == seats_->end() ? 0 : found->second;
  if (all >= parts_.limits.connections || of_it >= parts_.limits.of_one_address) return nullptr;
  ++(*seats_)[address];
  // Not owned by the pointer, which only has to be one.
  return {seats_.get(), [seats = seats_, address](void*) {
            if (--(*seats)[address] == 0) seats->erase(address);
          }};
}

bool ViewServer::take_page(boost::beast::tcp_stream&& stream, const HttpRequest& request,
                           const std::shared_ptr<void>& seat) {
  std::erase_if(pages_, [](const auto& page) { return page.expired(); });
  if (pages_.size() >= parts_.limits.pages) return false;
  const auto page = std::make_shared<PageClient>(std::move(stream), parts_, seat);
  pages_.push_back(page);
  page->start(request);
  return true;
}

void ViewServer::tell_pages() {
  for (const auto& page : pages_)
    if (const auto open = page.lock()) open->pump();
}

bool ViewServer::is_watched() const {
  return std::ranges::any_of(pages_, [](const auto& page) {
    const auto open = page.lock();
    return open != nullptr && open->is_watching();
  });
}

}  // namespace topo::daemon
