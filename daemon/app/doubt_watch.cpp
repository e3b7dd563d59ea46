// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/doubt_watch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "daemon/mapfile/doubt_json.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

void DoubtWatch::tick(types::Stamp now, const MappingReport& report) {
  if (report.map != found_.map && found_.map != 0) {  // the map that was looked at is gone
    found_ = {};
    hand_overs_.to_planning.doubted.store({});
  }
  const bool is_new = report.map != found_.map || report.revision != found_.revision;
  if (looking_ || now < next_ || !is_new || report.keyframes == 0) return;
  auto job = [this, scans = scan_count(report), begun = now]() -> Background::Finish {
    return [this, begun, found = doubter_.find(scans)] { take(found, begun); };
  };
  looking_ = files_.add(std::move(job)).has_value();
  next_ = now + kPeriod;
}

void DoubtWatch::take(const types::Result<FoundDoubt>& found, types::Stamp begun) {
  const types::Stamp now = io::monotonic_now();
  looking_ = false;
  next_ = std::max(next_, now + kShare * (now - begun));
  if (!found) return;  // there is another look
  const bool was_doubted = found_.doubt.is_doubted();
  found_ = *found;
  if (found_.doubt.is_doubted() && !was_doubted) spdlog::warn("{}", text());
  if (!found_.doubt.is_doubted() && was_doubted) spdlog::info("the map is not doubted any more");
  hand_overs_.to_planning.doubted.store(found_.look_again);
}

std::string DoubtWatch::text() const { return doubt_text(found_.doubt); }

Json DoubtWatch::json() const {
  if (found_.map == 0) return nullptr;
  Json places = Json::array();
  for (const types::Vector2& place : found_.look_again)
    places.push_back({{"x_m", place.x()}, {"y_m", place.y()}});
  return {{"revision", found_.revision},
          {"figure", found_.doubt.figure},
          {"why", text()},
          {"look_again", std::move(places)}};
}

}  // namespace topo::daemon
