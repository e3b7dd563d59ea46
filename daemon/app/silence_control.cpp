// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/silence_control.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "daemon/estop/latch_file.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kForgetAgain = std::chrono::seconds(1);

LatchStore silence_store(const std::string& file) {
  return {[file](const std::string& reason) { return keep_latch(file, reason); },
          [file] { return remove_latch(file); }};
}

}  // namespace

SilenceControl::SilenceControl(std::function<const pipeline::ControlReport&()> base,
                               const std::string& folder)
    : base_(std::move(base)),
      file_(folder.empty() ? std::string() : silence_path(folder)),
      keeper_(silence_store(file_)) {}

types::Status SilenceControl::start() {
  if (file_.empty()) return {};
  const FoundLatch found = read_latch(file_);
  silent_ = found.latched;
  if (silent_) spdlog::warn("base: did not obey before the start, nothing is sent to it: {}", found.text);
  return keeper_.start();
}

void SilenceControl::tick(types::Stamp now) {
  collect(now);
  const pipeline::ControlReport& base = base_();
  if (file_.empty() || base.stamp == types::Stamp{}) return;
  const bool disobeys = has(base.plausibility.doubts, plausibility::Doubt::kDisobeys);
  const bool again = !disobeys && forget_again_ != types::Stamp{} && now >= forget_again_;
  if (disobeys == silent_ && !again) return;
  silent_ = disobeys;
  forget_again_ = {};
  wish_ = disobeys ? keeper_.keep(std::string(plausibility::text_of(plausibility::Doubt::kDisobeys).found))
                   : keeper_.forget();
}

void SilenceControl::collect(types::Stamp now) {
  const auto done = keeper_.take_done();
  if (!done || done->wish != wish_) return;  // of a wish that was overtaken
  const std::string why = done->outcome ? std::string() : done->outcome.error().message;
  if (!why.empty() && !silent_) forget_again_ = now + kForgetAgain;
  const char* fails = silent_ ? "nothing is sent to it, but that is NOT kept over a restart: "
                              : "it will be taken for disobedient at the next start: ";
  const std::string before = std::exchange(trouble_, why.empty() ? why : fails + why);
  if (trouble_ == before) return;  // tried again, in vain as before
  if (!trouble_.empty()) spdlog::error("base: {}", trouble_);
}

}  // namespace topo::daemon
