// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/calibration/calibration_text.hpp"

#include <fmt/format.h>

#include <iterator>

#include "daemon/calibration/refusal_text.hpp"

namespace topo::daemon {
std::string calibration_text(const calibration::Calibration& found, std::span<const CalibratedValue> values) {
  const calibration::DriveEvidence& e = found.evidence;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out, "a drive of {:.0f} s and {:.1f} m, turned {:.0f} degrees to the left and {:.0f} to the right\n",
      e.seconds, e.way_m, in_degrees(e.turned_left_rad), in_degrees(e.turned_right_rad));
  fmt::format_to(out, "{} scans, {:.0f} % matched; {:.0f} % of {} pieces left out\n\n", e.scans,
                 100.0 * e.matched, 100.0 * e.left_out, e.intervals);
  if (!values.empty())
    fmt::format_to(out, "{:<26}{:>10}{:>10}{:>10}  {}\n", "key", "before", "found", "+-", "effect");
  for (const CalibratedValue& v : values)
    fmt::format_to(out, "{:<26}{:>10.4f}{:>10.4f}{:>10.4f}  {}\n", v.key, v.before, v.found, v.sigma,
                   v.effect);
  if (found.coronal && !found.coronal->has_floor)
    fmt::format_to(out, "scanner.coronal: too little floor seen to both sides; its roll and height stay\n");
  if (found.coronal && found.coronal->has_floor && !found.coronal->has_walls)
    fmt::format_to(out, "scanner.coronal: too few walls seen by both scanners; its place stays\n");
  for (const calibration::Refusal& refusal : found.refusals)
    fmt::format_to(out, "\nrefused: {}", refusal_text(refusal));
  fmt::format_to(out, "{}", found.refusals.empty() ? "\nbelievable\n" : "\n");
  return text;
}

nlohmann::json calibration_json(const calibration::Calibration& found,
                                std::span<const CalibratedValue> values) {
  const calibration::DriveEvidence& e = found.evidence;
  nlohmann::json json{{"believable", found.believable()},
                      {"drive",
                       {{"seconds", e.seconds},
                        {"way_m", e.way_m},
                        {"turned_left_rad", e.turned_left_rad},
                        {"turned_right_rad", e.turned_right_rad},
                        {"scans", e.scans},
                        {"matched", e.matched},
                        {"pieces", e.intervals},
                        {"left_out", e.left_out}}},
                      {"values", nlohmann::json::object()},
                      {"refused", nlohmann::json::array()}};
  for (const CalibratedValue& v : values)
    json["values"][v.key] = {{"before", v.before}, {"found", v.found}, {"sigma", v.sigma}};
  for (const calibration::Refusal& refusal : found.refusals) json["refused"].push_back(refusal_text(refusal));
  return json;
}

}  // namespace topo::daemon
