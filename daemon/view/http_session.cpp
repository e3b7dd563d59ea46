// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/http_session.hpp"

#include <fmt/format.h>

#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <map>
#include <string_view>
#include <utility>

#include "daemon/view/page.hpp"
#include "daemon/view/request_check.hpp"

namespace topo::daemon {
namespace {

namespace http = boost::beast::http;
using boost::beast::error_code;

constexpr auto kRequestPatience = std::chrono::seconds(10);
constexpr std::size_t kBodyMax = 0;  // no request has one
constexpr std::string_view kSocketTarget = "/ws";

std::string_view field(const HttpRequest& request, http::field name) {
  const auto found = request.find(name);
  if (found == request.end()) return {};
  return {found->value().data(), found->value().size()};
}

/// A header that stands twice says nothing that can be relied on.
bool stands_once(const HttpRequest& request, http::field name) { return request.count(name) <= 1; }

std::string_view target_of(const HttpRequest& request) {
  return {request.target().data(), request.target().size()};
}

/// Some browsers do not take a WebSocket for 'self', so that the host is named. It was checked before.
std::string policy(std::string_view host) {
  return fmt::format(
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self' ws://{0} "
      "wss://{0}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
      host);
}

HttpResponse plain(const HttpRequest& request, http::status status, std::string_view text) {
  HttpResponse response(status, request.version());
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.body() = text;
  return response;
}

/// Packed once: the files do not change while the program runs.
const std::string& packed(const PageFile& file) {
  static std::map<std::string_view, std::string> all;
  std::string& bytes = all[file.name];
  if (bytes.empty()) bytes = gzip(file.bytes);
  return bytes;
}

HttpResponse with_file(const HttpRequest& request, const PageFile& file) {
  HttpResponse response(http::status::ok, request.version());
  response.set(http::field::content_type, std::string(media_type(file.name)));
  response.set(http::field::vary, "Accept-Encoding");
  if (field(request, http::field::accept_encoding).find("gzip") != std::string_view::npos) {
    response.set(http::field::content_encoding, "gzip");
    response.body() = packed(file);
  } else {
    response.body() = file.bytes;
  }
  return response;
}

HttpResponse choose(const HttpRequest& request, const std::vector<std::string>& hosts) {
  if (!is_permitted(request, hosts)) {
    return plain(request, http::status::forbidden,
                 "Not from here: this robot does not know the name it was called by (view.hosts), or another "
                 "site's page asks.\n");
  }
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return plain(request, http::status::method_not_allowed, "GET and HEAD only.\n");
  const PageFile* file = find_page_file(target_of(request));
  return file == nullptr ? plain(request, http::status::not_found, "No such file.\n")
                         : with_file(request, *file);
}

}  // namespace

bool is_permitted(const HttpRequest& request, const std::vector<std::string>& hosts) {
  if (!stands_once(request, http::field::host) || !stands_once(request, http::field::origin)) return false;
  const std::string_view host = field(request, http::field::host);
  return is_own_host(host, hosts) && is_own_origin(field(request, http::field::origin), host);
}

HttpResponse answer_request(const HttpRequest& request, const std::vector<std::string>& hosts) {
  HttpResponse response = choose(request, hosts);
  const bool permitted = response.result() != http::status::forbidden;
  response.set("Content-Security-Policy",
               permitted ? policy(field(request, http::field::host)) : "default-src 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set(http::field::x_frame_options, "DENY");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set(http::field::cache_control, "no-cache");
  response.keep_alive(request.keep_alive());
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();  // the length stays
  return response;
}

void HttpSession::read() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(parts_.limits.header_bytes));
  parser_->body_limit(kBodyMax);
  stream_.expires_after(kRequestPatience);
  http::async_read(stream_, in_, *parser_, [self = shared_from_this()](const error_code& ended, std::size_t) {
    if (ended) return self->stream_.close();
    self->serve(self->parser_->get());
  });
}

void HttpSession::serve(const HttpRequest& request) {
  if (!boost::beast::websocket::is_upgrade(request)) return send(answer_request(request, parts_.hosts));
  if (!is_permitted(request, parts_.hosts) || target_of(request) != kSocketTarget)
    return send(answer_request(request, parts_.hosts));
  if (take_page_(std::move(stream_), request, seat_)) return;
  HttpResponse full = plain(request, http::status::service_unavailable, "Too many pages are open.\n");
  full.prepare_payload();
  send(std::move(full));
}

void HttpSession::send(HttpResponse response) {
  response_.emplace(std::move(response));
  http::async_write(stream_, *response_, [self = shared_from_this()](const error_code& failed, std::size_t) {
    if (failed || !self->response_->keep_alive()) return self->stream_.close();
    self->read();
  });
}

}  // namespace topo::daemon
