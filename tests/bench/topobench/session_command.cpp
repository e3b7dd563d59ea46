// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/session_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/slam/keyframe_codec.hpp"
#include "core/slam/localise.hpp"
#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/session/session_reader.hpp"
#include "daemon/session/session_writer.hpp"
#include "tests/bench/topobench/log_run.hpp"
#include "tests/bench/topobench/output.hpp"

namespace topo::bench {
namespace {

using Clock = std::chrono::steady_clock;

double elapsed_s(Clock::time_point since) {
  return std::chrono::duration<double>(Clock::now() - since).count();
}

/// What a keyframe takes in memory.
std::size_t memory_of(const slam::Keyframe& k) { return sizeof k + k.content.bytes().size(); }
/// What its points take where they are read.
std::size_t decoded_bytes(const slam::CodedContent& content) {
  return sizeof(slam::Point) * (content.hits().size() + content.match_points().size()) +
         sizeof(slam::Surfel) * content.surfels().size() +
         sizeof(walls::ColumnPoint) * content.columns().size();
}

nlohmann::json sizes(const slam::Session& session, std::size_t file_bytes) {
  std::size_t memory = 0, decoded = 0, encoded = 0, hits = 0;
  for (const slam::KeyframePtr& keyframe : session.keyframes) {
    memory += memory_of(*keyframe);
    decoded += decoded_bytes(keyframe->content);
    encoded += slam::encode_keyframe(*keyframe).size();
    hits += keyframe->content.hits().size();
  }
  const double n = std::max<double>(1.0, static_cast<double>(session.keyframes.size()));
  return {{"keyframes", session.keyframes.size()},
          {"edges", session.edges.size()},
          {"hits_per_keyframe", static_cast<double>(hits) / n},
          {"memory_bytes_per_keyframe", static_cast<double>(memory) / n},
          {"decoded_bytes_per_keyframe", static_cast<double>(decoded) / n},
          {"encoded_bytes_per_keyframe", static_cast<double>(encoded) / n},
          {"file_bytes_per_keyframe", static_cast<double>(file_bytes) / n},
          {"file_bytes", file_bytes},
          {"ratio", static_cast<double>(decoded) / static_cast<double>(file_bytes)}};
}

/// Scans of the log, evenly spread, that are looked for anywhere; wrong: more than 0.5 m from where the
/// mapper had them.
nlohmann::json localise(const SessionCommand& command, const CarmenLog& log,
                        const std::vector<TimedPose>& trajectory, const slam::Session& session,
                        const slam::MapperParams& params) {
  std::size_t found = 0, ambiguous = 0, refused = 0, wrong = 0;
  std::vector<double> seconds{0.0};
  types::Scan scan;
  slam::Cloud cloud;
  const auto count = std::min<std::size_t>(static_cast<std::size_t>(command.localise), trajectory.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (2 * k + 1) * trajectory.size() / (2 * count);
    fill_scan(log.scans[i], log.scans[i].stamp_s, i, scan);
    slam::make_cloud(scan, params.T_base_laser, {}, params.cloud, cloud);
    const auto begin = Clock::now();
    const slam::Localisation place = slam::localise_anywhere(session, cloud, params);
    seconds.push_back(elapsed_s(begin));
    const types::Se2 off = trajectory[i].pose.inverse() * place.match.T_map_base;
    const bool near = off.translation().norm() < 0.5 && std::abs(off.theta_rad) < 0.2;
    found += place.found() && near ? 1U : 0U;
    wrong += place.found() && !near ? 1U : 0U;
    ambiguous += place.refusal == slam::LocaliseRefusal::kAmbiguous ? 1U : 0U;
    refused += !place.found() && place.refusal != slam::LocaliseRefusal::kAmbiguous ? 1U : 0U;
  }
  return {{"scans", count},
          {"found", found},
          {"wrong", wrong},
          {"ambiguous", ambiguous},
          {"refused", refused},
          {"mean_s", std::accumulate(seconds.begin(), seconds.end(), 0.0) /
                         static_cast<double>(std::max<std::size_t>(1, count))},
          {"max_s", *std::max_element(seconds.begin(), seconds.end())}};
}

}  // namespace

types::Status run_session(const SessionCommand& command) {
  const auto log = read_log(command.log, options_of(command.beams_deg));
  if (!log) return tl::unexpected(log.error());
  print_remarks(command.log, *log);
  if (auto made = make_folder(std::filesystem::path(command.out).parent_path()); !made) return made;
  const slam::MapperParams params = params_for(*log);
  pipeline::MappingState state(params);
  const auto run = run_log(*log, state);
  const slam::Session session = state.mapper().session();
  auto begin = Clock::now();
  const auto bytes = daemon::session_bytes(session, 0);
  if (!bytes) return tl::unexpected(bytes.error());
  nlohmann::json json = sizes(session, bytes->size());
  json["encode_s"] = elapsed_s(begin);
  begin = Clock::now();
  const auto loaded = daemon::parse_session(*bytes);
  if (!loaded) return tl::unexpected(loaded.error());
  json["load_s"] = elapsed_s(begin);
  json["localise"] = localise(command, *log, run.trajectory, loaded->session, params);
  if (!command.out.empty()) {
    if (auto written = daemon::write_file(command.out, *bytes); !written) return written;
  }
  fmt::print("{}\n", command.json ? json.dump() : json.dump(2));
  return {};
}

}  // namespace topo::bench
