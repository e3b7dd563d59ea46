// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The first configuration. This command talks to base and scanners themselves, not to the daemon.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "daemon/calibration/configuration_file.hpp"
#include "daemon/config/trimmed.hpp"
#include "daemon/setup/configuration_text.hpp"
#include "daemon/setup/dialogue_text.hpp"
#include "daemon/topoctl/answer_lines.hpp"
#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/setup_screen.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using types::Duration;
using types::Stamp;

// With 12 answers that all look, these stay below five minutes.
constexpr Duration kSearchLimit = std::chrono::seconds(60);
constexpr Duration kLookLimit = std::chrono::seconds(5);
constexpr std::size_t kScansOfALook = 10;
constexpr Duration kTurn = std::chrono::milliseconds(5);  ///< of one scanner
constexpr Duration kInputTurn = std::chrono::milliseconds(20);

/// The command at work.
struct Work {
  SetupArguments arguments;
  std::vector<LiveScanner> scanners;
  SetupScreen screen;
  AnswerLines lines{STDIN_FILENO};
  Duration own_time{};  ///< of the program, without that of whoever answers
};

void step_scanners(Work& work) {
  for (LiveScanner& scanner : work.scanners) scanner.step(kTurn);
}

/// The next answer; nothing when none will come.
std::optional<std::string> next_answer(Work& work, const SetupState& state) {
  while (!interrupted() && !work.lines.ended()) {
    if (auto line = work.lines.next()) return line;
    const Stamp turn_end = io::monotonic_now() + kInputTurn;
    step_scanners(work);
    work.screen.refresh(state, work.scanners, io::monotonic_now());
    io::sleep_until(turn_end);
  }
  return std::nullopt;
}

/// At a terminal: time to walk to where the question wants somebody.
void count_down(Work& work) {
  if (!work.screen.is_terminal()) return;
  const Stamp end = io::monotonic_now() + types::from_seconds(work.arguments.countdown_s);
  long told = -1;
  while (!interrupted() && io::monotonic_now() < end) {
    const auto left = std::chrono::ceil<std::chrono::seconds>(end - io::monotonic_now()).count();
    if (left != told) fmt::print("\r{} ... ", left);
    told = left;
    std::fflush(stdout);
    step_scanners(work);
  }
  fmt::print("\r\033[K");
}

/// Pictures of scans that begin now. A scanner that sends too few has an empty one.
std::vector<calibration::StillPicture> look(Work& work) {
  step_scanners(work);  // what was seen before is left out
  for (LiveScanner& scanner : work.scanners) scanner.begin_picture();
  const Stamp end = io::monotonic_now() + kLookLimit;
  const auto lacks = [](const LiveScanner& scanner) { return scanner.scans() < kScansOfALook; };
  while (!interrupted() && io::monotonic_now() < end &&
         std::any_of(work.scanners.begin(), work.scanners.end(), lacks))
    step_scanners(work);
  std::vector<calibration::StillPicture> out;
  for (const LiveScanner& scanner : work.scanners)
    out.push_back(lacks(scanner) ? calibration::StillPicture{} : scanner.picture());
  return out;
}

SetupState asked(Work& work, SetupState state) {
  work.screen.ask(state, work.scanners);
  const auto answer = next_answer(work, state);
  work.screen.leave();
  if (!work.screen.is_terminal()) fmt::print("\n");
  if (!answer || interrupted()) {
    state.end = SetupEnd::kRefused;
    state.remark = "the answers ended before the questions.";
    return state;
  }
  const Stamp begin = io::monotonic_now();
  std::vector<calibration::StillPicture> pictures;
  if (question(state).looks && trimmed(*answer).empty()) {
    count_down(work);
    pictures = look(work);
  }
  SetupState next = answered(std::move(state), *answer, pictures);
  work.own_time += io::monotonic_now() - begin;
  return next;
}

SearchPlaces places_of(const SetupArguments& arguments) {
  SearchPlaces places;
  // Who names one kind of place does not mean the usual ones of the other.
  if (!arguments.serial.empty() || !arguments.tcp.empty()) {
    places.serial = arguments.serial;
    places.tcp = arguments.tcp;
  }
  places.bases = arguments.bases;
  return places;
}

int refuse(const std::string& why) {
  fmt::print(stderr, "topoctl: {}\ntopoctl: nothing was written\n", why);
  return kFailed;
}

std::filesystem::path folder_of(const std::string& file) {
  std::error_code error;
  return std::filesystem::absolute(file, error).parent_path();
}

/// Before anything is asked: why the file could not be written; empty: it could. Its folder is made when only
/// it is missing.
std::string unwritable(const std::string& file) {
  std::error_code error;
  auto folder = folder_of(file);
  if (!std::filesystem::exists(folder, error)) folder = folder.parent_path();
  if (::access(folder.c_str(), W_OK) == 0) return {};
  return io::error_of_errno(folder.string(), "writing there", errno).message;
}

int finish(Work& work, const SetupState& state) {
  for (LiveScanner& scanner : work.scanners) scanner.close();
  if (state.end != SetupEnd::kAgreed) return refuse(state.remark);
  std::error_code error;
  std::filesystem::create_directory(folder_of(state.file),
                                    error);  // a failure shows when the file is written
  const auto kept = replace_configuration(state.file, configuration_text(state.text, state.values));
  if (!kept) return refuse(kept.error().message);
  fmt::print("written to {}{}{}\n{} answers, {:.0f} s of this program's time\n", state.file,
             kept->empty() ? "" : "; as it was before: ", *kept, state.answers,
             types::to_seconds(work.own_time));
  fmt::print("next: topometricd --config {0}; topoctl doctor; topoctl wheels-up; topoctl calibrate\n",
             state.file);
  return kOk;
}

}  // namespace

int set_up(const Arguments& a) {
  catch_signals();
  const std::string& file = a.setup.config;
  const auto written = read_text(file);
  if (!written && written.error().code != types::Errc::kNotFound) return refuse(written.error().message);
  if (const std::string why = unwritable(file); !why.empty()) return refuse(why);
  fmt::print("looking for base and scanners, which takes up to a minute; the daemon must not run\n");
  std::fflush(stdout);
  Work work{a.setup, {}, SetupScreen(::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1)};
  const Stamp begin = io::monotonic_now();
  SearchResult search = search_devices(places_of(a.setup), kSearchLimit, &interrupted);
  work.own_time = io::monotonic_now() - begin;
  work.scanners = std::move(search.scanners);
  fmt::print("{}", found_text(search.found));
  SetupState state = begin_setup(std::move(search.found), file,
                                 written ? std::optional<std::string>(*written) : std::nullopt);
  while (!state.end) state = asked(work, std::move(state));
  return finish(work, state);
}

}  // namespace topo::daemon
