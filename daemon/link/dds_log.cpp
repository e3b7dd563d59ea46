// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/dds_log.hpp"

#include <dds/ddsrt/log.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <mutex>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// DDS calls from any of its threads.
struct Sink {
  std::mutex mutex;
  LineLimit limit;
  std::function<void()> refused;
};

void take_line(void* argument, const dds_log_data_t* data) {
  auto& sink = *static_cast<Sink*>(argument);
  std::string_view line(data->message, data->size);
  while (!line.empty() && (line.back() == '\n' || line.back() == '\0')) line.remove_suffix(1);
  const std::lock_guard lock(sink.mutex);
  if (is_refusal(line) && sink.refused) sink.refused();
  if (const auto text = sink.limit.pass(io::monotonic_now(), line)) spdlog::warn("DDS: {}", *text);
}

}  // namespace

std::optional<std::string> LineLimit::pass(types::Stamp now, std::string_view line) {
  if (now - begin_ >= params_.period) {
    begin_ = now;
    passed_ = 0;
  }
  if (passed_ >= params_.lines) {
    ++left_out_;
    return {};
  }
  ++passed_;
  const int before = std::exchange(left_out_, 0);
  return before == 0 ? std::string(line) : fmt::format("{} ({} lines left out before)", line, before);
}

bool is_refusal(std::string_view line) {
  const auto has = [line](std::string_view part) { return line.find(part) != std::string_view::npos; };
  return (has("handshake") && has("failed")) || has("Access control does not allow remote");
}

void log_of_dds(std::function<void()> refused) {
  static Sink sink;
  {
    const std::lock_guard lock(sink.mutex);
    sink.refused = std::move(refused);
  }
  dds_set_log_mask(DDS_LC_FATAL | DDS_LC_ERROR | DDS_LC_WARNING);
  dds_set_log_sink(&take_line, &sink);
}

void end_log_of_dds() {
  dds_set_log_sink([](void*, const dds_log_data_t*) {}, nullptr);
}

}  // namespace topo::daemon
