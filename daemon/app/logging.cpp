// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/logging.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/async.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace topo::daemon {
namespace {

struct LevelName {
  std::string_view name;
  LogLevel level;
  spdlog::level::level_enum spd;
};
constexpr std::array<LevelName, 5> kLevels{{{"trace", LogLevel::kTrace, spdlog::level::trace},
                                            {"debug", LogLevel::kDebug, spdlog::level::debug},
                                            {"info", LogLevel::kInfo, spdlog::level::info},
                                            {"warning", LogLevel::kWarning, spdlog::level::warn},
                                            {"error", LogLevel::kError, spdlog::level::err}}};

/// "<4>": the priority that the journal reads at the beginning of a line of standard error.
class PriorityPrefix final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    constexpr std::array<char, 7> kPriority{'7', '7', '6', '4', '3', '2', '6'};
    const auto level = static_cast<std::size_t>(message.level);
    const char digit = level < kPriority.size() ? kPriority[level] : '6';
    const std::array<char, 3> prefix{'<', digit, '>'};
    out.append(prefix.data(), prefix.data() + prefix.size());
  }
  [[nodiscard]] std::unique_ptr<spdlog::custom_flag_formatter> clone() const override {
    return std::make_unique<PriorityPrefix>();
  }
};

}  // namespace

types::Status start_logging(const LogConfig& config) {
  spdlog::sink_ptr sink;
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PriorityPrefix>('*');
  if (config.file.empty()) {
    sink = std::make_shared<spdlog::sinks::stderr_sink_st>();
    // The journal adds time and priority itself; a terminal needs both in the text.
    formatter->set_pattern(std::getenv("JOURNAL_STREAM") != nullptr ? "%*%v" : "%Y-%m-%d %H:%M:%S.%e %l: %v");
  } else {
    // Tested first, because spdlog would throw.
    const int fd = ::open(config.file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0640);
    if (fd < 0) {
      return types::fail(errno == EACCES ? types::Errc::kPermission : types::Errc::kIo,
                         fmt::format("log.file {}: {}; expected a file that can be written", config.file,
                                     std::strerror(errno)),
                         errno);
    }
    ::close(fd);
    sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(config.file);
    formatter->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  }
  constexpr std::size_t kLines = 1024;
  spdlog::init_thread_pool(kLines, 1);
  auto logger = std::make_shared<spdlog::async_logger>("topometricd", std::move(sink), spdlog::thread_pool(),
                                                       spdlog::async_overflow_policy::overrun_oldest);
  logger->set_formatter(std::move(formatter));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
  set_log_level(config.level);
  return {};
}

void end_logging() { spdlog::shutdown(); }

void set_log_level(LogLevel level) {
  for (const auto& entry : kLevels) {
    if (entry.level == level) spdlog::set_level(entry.spd);
  }
}

std::optional<LogLevel> parse_log_level(std::string_view text) {
  for (const auto& entry : kLevels) {
    if (entry.name == text) return entry.level;
  }
  return {};
}

}  // namespace topo::daemon
