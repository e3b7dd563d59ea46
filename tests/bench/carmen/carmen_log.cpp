// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/carmen_log.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

#include "tests/bench/carmen/carmen_lines.hpp"
#include "tests/bench/carmen/log_finish.hpp"
#include "tests/bench/carmen/log_order.hpp"
#include "tests/bench/carmen/passed_over.hpp"

namespace topo::bench {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

namespace {

bool is_message_name(std::string_view word) {
  if (word.front() < 'A' || word.front() > 'Z') return false;
  return word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == std::string_view::npos;
}

/// Messages with scans, the one to be taken first. New logs hold a sweep in several of them.
constexpr std::array<std::string_view, 22> kOrder{
    "ROBOTLASER1", "FLASER",      "ROBOTLASER0", "ROBOTLASER2", "RLASER",      "ROBOTLASER3",
    "ROBOTLASER4", "ROBOTLASER5", "ROBOTLASER6", "ROBOTLASER7", "ROBOTLASER8", "ROBOTLASER9",
    "RAWLASER1",   "RAWLASER0",   "RAWLASER2",   "RAWLASER3",   "RAWLASER4",   "RAWLASER5",
    "RAWLASER6",   "RAWLASER7",   "RAWLASER8",   "RAWLASER9"};

Layout layout_of(std::string_view name) {
  if (name.starts_with("ROBOT")) return Layout::kRobotLaser;
  return name.starts_with("RAW") ? Layout::kRawLaser : Layout::kFlaser;
}

Result<CarmenScan> read_scan(const Fields& f, Layout layout) {
  if (layout == Layout::kRobotLaser) return read_robotlaser(f);
  return layout == Layout::kRawLaser ? read_rawlaser(f) : read_flaser(f);
}

/// What the lines of a log hold, while it is read.
class Collector {
 public:
  explicit Collector(const LineSource& source) : source_(source) {}

  void take(const Fields& f) {
    if (f.is_comment()) return;
    const std::string_view name = f.word(0);
    if (std::find(kOrder.begin(), kOrder.end(), name) != kOrder.end()) return take_scan(f);
    if (name == "ODOM") return take_odometry(f);
    if (name == "PARAM") facts_.take(f);
    (is_message_name(name) ? others_ : foreign_).add(source_.line(), name);
  }

  /// The log of the first message that has scans.
  Result<CarmenLog> finish(const LogOptions& options) {
    if (odometry_error_) return tl::unexpected(*odometry_error_);
    for (const std::string_view name : kOrder) {
      const auto found = sweeps_.find(name);
      if (found != sweeps_.end()) return finish(found->first, found->second, options);
    }
    const std::string held = others_.named(), strange = foreign_.named();
    return fail(
        Errc::kInvalidInput,
        fmt::format(
            "{}: found no scan in {} lines{}{}{}{}{}, expected a CARMEN log with FLASER, RLASER or "
            "ROBOTLASER1 messages, or RAWLASER1 and ODOM",
            source_.path(), source_.line(), held.empty() && odometry_.empty() ? "" : ", but ",
            odometry_.empty() ? "" : fmt::format("{} of ODOM{}", odometry_.size(), held.empty() ? "" : ", "),
            held, strange.empty() ? "" : ", and lines that no CARMEN log has: ", strange));
  }

 private:
  void take_scan(const Fields& f) {
    const Layout layout = layout_of(f.word(0));
    auto scan = read_scan(f, layout);
    if (!scan && source_.is_cut()) return note_cut(f);
    Sweeps& sweeps = sweeps_[std::string(f.word(0))];
    sweeps.layout = layout;
    if (!scan) {
      if (!sweeps.error) sweeps.error = scan.error();
      return;
    }
    sweeps.first_line.emplace(scan->range_m.size(), source_.line());
    if (layout != Layout::kFlaser && states_two_fans(f)) ++sweeps.two_fans;
    sweeps.scans.push_back(std::move(*scan));
  }

  void take_odometry(const Fields& f) {
    auto odometry = read_odometry(f);
    if (odometry) {
      odometry_.push_back(*odometry);
    } else if (source_.is_cut()) {
      note_cut(f);
    } else if (!odometry_error_) {
      odometry_error_ = odometry.error();
    }
  }

  void note_cut(const Fields& f) {
    remarks_.push_back(fmt::format("passed over the last line, {}, which is {} that was cut off",
                                   source_.line(), printable(f.word(0))));
  }

  Result<CarmenLog> finish(const std::string& name, Sweeps& sweeps, const LogOptions& options) {
    CarmenLog log;
    if (foreign_.count() > 0) log.remarks.push_back(foreign_.remark("that no CARMEN log has"));
    log.remarks.insert(log.remarks.end(), remarks_.begin(), remarks_.end());
    log.odometry_inversions = sort_by_stamp(odometry_);
    log.odometry = std::move(odometry_);
    log.foreign_lines = foreign_.count();
    log.other_lines = others_.count();
    for (const auto& [other, ignored] : sweeps_) {
      if (other != name) log.scans_ignored += static_cast<int>(ignored.scans.size());
    }
    const bool rear = name == "RLASER" || name == "ROBOTLASER2" || name == "RAWLASER2";
    const SweepContext context{source_.path(), name, rear ? facts_.rear : facts_.front, options};
    if (auto s = finish_sweeps(context, sweeps, log); !s) return tl::unexpected(s.error());
    return log;
  }

  const LineSource& source_;
  std::map<std::string, Sweeps, std::less<>> sweeps_;  ///< by the name of the message
  std::vector<CarmenOdometry> odometry_;
  std::optional<types::Error> odometry_error_;
  LogFacts facts_;
  PassedOver others_, foreign_;
  std::vector<std::string> remarks_;
};

}  // namespace

Result<CarmenLog> read_carmen_log(const std::string& path, const LogOptions& options) {
  auto source = LineSource::open(path);
  if (!source) return tl::unexpected(source.error());
  Collector found(*source);
  const auto whole = read_lines(*source, [&found](const Fields& f) -> Status {
    found.take(f);
    return {};
  });
  if (!whole) return tl::unexpected(whole.error());
  return found.finish(options);
}

}  // namespace topo::bench
