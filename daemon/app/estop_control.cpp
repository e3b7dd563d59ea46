// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/estop_control.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "daemon/estop/latch_file.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::Status;

namespace {

constexpr const char* kCure = "clear it first (topoctl clear-estop)";
constexpr const char* kNoFolder = "control.state_folder is empty";

LatchStore file_store(const std::string& file) {
  return {[file](const std::string& reason) { return keep_latch(file, reason); },
          [file] { return remove_latch(file); }};
}

}  // namespace

EStopControl::EStopControl(sync::EStopLine<>& line, std::function<const pipeline::ControlReport&()> base,
                           const std::string& folder, Announce announce)
    : line_(line),
      base_(std::move(base)),
      file_(folder.empty() ? std::string() : latch_path(folder)),
      announce_(std::move(announce)),
      keeper_(file_store(file_)) {}

Status EStopControl::start() {
  if (file_.empty()) return {};
  const FoundLatch found = read_latch(file_);
  if (found.latched) {
    line_.press();
    since_before_ = found.text;
    keeping_ = Keeping::kKept;
    spdlog::warn("e-stop: latched since before the start, until topoctl clear-estop: {}", found.text);
    if (found.damaged) keep("found damaged at the start: " + found.text);
  }
  return keeper_.start();
}

void EStopControl::press() {
  const bool news = !line_.pressed();
  line_.press();
  if (news) spdlog::warn("e-stop");
  fail_clears({Errc::kBusy, "the e-stop was pressed again meanwhile; it stays latched"});
  keep("an operator's e-stop");
}

void EStopControl::tick() {
  if (clears_.empty() && latched()) keep("the stop button on the robot, or a latch of the base");
}

void EStopControl::keep(const std::string& reason) {
  const bool wanted = keeping_ != Keeping::kNothing;
  const bool rewritten = keeping_ == Keeping::kKept && reason.starts_with("found damaged");
  if (wanted && !rewritten) return;
  if (file_.empty()) {
    keeping_ = Keeping::kFailed;
    why_not_ = kNoFolder;
    return;
  }
  keeping_ = Keeping::kPending;
  wish_ = keeper_.keep(reason);
}

void EStopControl::clear(Done done) {
  clears_.push_back(std::move(done));
  if (clears_.size() > 1) return;  // answered together
  keeping_ = Keeping::kNothing;
  if (file_.empty()) return release();
  wish_ = keeper_.forget();
}

void EStopControl::collect() {
  const auto done = keeper_.take_done();
  if (!done || done->wish != wish_) return;  // of a wish that was overtaken
  if (clears_.empty())
    note_kept(done->outcome);
  else
    note_forgotten(done->outcome);
}

void EStopControl::note_kept(const Status& outcome) {
  const std::string why = outcome ? std::string() : outcome.error().message;
  const Keeping now = outcome ? Keeping::kKept : Keeping::kFailed;
  if (now == keeping_ && why == why_not_) return;  // tried again, in vain as before
  keeping_ = now;
  why_not_ = why;
  if (outcome)
    spdlog::info("e-stop: kept in {}: latched after a restart, too", file_);
  else
    spdlog::error("e-stop: latched, but NOT kept over a restart: {}", why);
  announce_({{"event", "estop_kept"}, {"kept", outcome.has_value()}, {"why", why}});
}

void EStopControl::note_forgotten(const Status& outcome) {
  if (outcome) return release();
  spdlog::error("e-stop: not cleared: {}", outcome.error().message);
  fail_clears(
      {Errc::kIo,
       fmt::format("the e-stop stays latched, because its file would latch it again at the next start: {}",
                   outcome.error().message)});
  keep("an operator's e-stop, not cleared: " + outcome.error().message);
}

void EStopControl::release() {
  line_.clear();
  cleared_ = io::monotonic_now();  // after the clear: a base that decides later has read it
  since_before_.clear();
  why_not_.clear();
  keeping_ = Keeping::kNothing;
  spdlog::info("e-stop cleared");
  for (const Done& done : std::exchange(clears_, {})) done({});
}

void EStopControl::fail_clears(const types::Error& error) {
  for (const Done& done : std::exchange(clears_, {})) done(tl::unexpected(error));
}

bool EStopControl::latched() const {
  const pipeline::ControlReport& base = base_();
  // A report of the base from before the clear is out of date.
  return line_.pressed() || (base.estop_latched && base.stamp > cleared_);
}

std::string EStopControl::obstacle() const {
  if (!latched()) return {};
  if (since_before_.empty()) return fmt::format("the e-stop is latched; {}", kCure);
  return fmt::format("the e-stop is latched since before the daemon's start ({}); {}", since_before_, kCure);
}

std::string EStopControl::trouble() const {
  if (keeping_ != Keeping::kFailed || file_.empty()) return {};
  return fmt::format("latched, but not kept over a restart: {}", why_not_);
}

Json EStopControl::json() const {
  const char* kept = keeping_ == Keeping::kKept      ? "yes"
                     : keeping_ == Keeping::kFailed  ? "no"
                     : keeping_ == Keeping::kPending ? "not yet"
                                                     : "";
  return {{"kept", kept}, {"why", why_not_}, {"since", since_before_}, {"file", file_}};
}

}  // namespace topo::daemon
