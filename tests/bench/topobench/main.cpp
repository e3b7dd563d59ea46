// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "daemon/app/command_line.hpp"
#include "drivers/io/run_program.hpp"
#include "tests/bench/topobench/analyse/analyse_command.hpp"
#include "tests/bench/topobench/analyse/segment_command.hpp"
#include "tests/bench/topobench/calibrate/calibrate_command.hpp"
#include "tests/bench/topobench/canonical/canonical_command.hpp"
#include "tests/bench/topobench/compass/compass_command.hpp"
#include "tests/bench/topobench/contact/contact_command.hpp"
#include "tests/bench/topobench/explore/calibrated_setup.hpp"
#include "tests/bench/topobench/explore/contender.hpp"
#include "tests/bench/topobench/explore/explore_command.hpp"
#include "tests/bench/topobench/goals/goals_command.hpp"
#include "tests/bench/topobench/judge/judge_command.hpp"
#include "tests/bench/topobench/posegraph/posegraph_command.hpp"
#include "tests/bench/topobench/session_command.hpp"
#include "tests/bench/topobench/slam_command.hpp"
#include "tests/bench/topobench/table_options.hpp"

namespace {

using topo::bench::not_empty;
using topo::daemon::number_from;

/// 2 is the user's fault, 1 everything else.
int exit_status(const topo::types::Error& error) {
  using topo::types::Errc;
  const bool users =
      error.code == Errc::kInvalidInput || error.code == Errc::kNotFound || error.code == Errc::kPermission;
  return users ? 2 : 1;
}

void add_beams(CLI::App& app, std::vector<double>& beams_deg) {
  app.add_option(
         "--beams", beams_deg,
         "START,STEP in degrees of the beams of a log that does not state them (FLASER, RLASER), where no "
         "known scanner has their number")
      ->needs("--log")
      ->delimiter(',')
      ->expected(2)
      ->check(number_from(-360.0, 360.0));
}

void add_options(CLI::App& app, topo::bench::SlamCommand& slam) {
  app.footer(
      "Times are processor time (match_ms: all that the mapping thread does for a scan), each stage also\n"
      "by the clock. revisit_within_0_1_m: of all ends of beams on surfaces that another visit looked at\n"
      "(at least 15 m of way later or earlier, and twice as much way as the two places are apart), the\n"
      "share within 0.1 m of the centre of an occupied cell that another visit hit. A visit looked at a\n"
      "surface that it hit so near, and at one that a beam of it contradicts, by ending behind it or\n"
      "before it on the same side. unlike_canonical: cells in another state than in the canonical map,\n"
      "of those known there. doubt: what speaks against the map without a truth, as shares: contradicted "
      "(of\n"
      "what was seen twice, in regions of 5 m where most of it was seen elsewhere the other time), lost and\n"
      "degenerate scans, tension (closures that the solution leaves out). figure: the greatest over its\n"
      "limit; above 1 the map is doubted, and a sentence on stderr says why.");
  auto* from = app.add_option_group("input")->require_option(1);
  from->add_option("--log", slam.log, "The log");
  from->add_option("--simulate", slam.simulate,
                   "A building (map_server YAML or scene .toml): a UTM-30LX on a patrol by a seeded route");
  add_beams(app, slam.beams_deg);
  app.add_option("--relations", slam.relations, "True relations (Kuemmerle et al. 2009) to measure against")
      ->needs("--log");
  app.add_option("--every", slam.thinning.every,
                 "Only each so many-th scan; relations are then those between two such scans")
      ->check(CLI::Range(1, 1000));
  app.add_option("--drop", slam.thinning.drop_share, "Share of the scans that is lost")
      ->check(CLI::Range(0.0, 0.95));
  app.add_option("--drop-seed", slam.thinning.drop_seed, "Which scans these are")
      ->needs("--drop")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  app.add_option("--split", slam.split,
                 "The log's halves as two robots that join their maps, beside the whole log as one: whether "
                 "they know where they start")
      ->needs("--log")
      ->check(CLI::IsMember({"known", "unknown"}));
  app.add_option("--hardship", slam.hardship,
                 "How many times as false the simulated wheels are, and as often they slip")
      ->needs("--simulate")
      ->capture_default_str()
      ->check(number_from(0.1, 10.0));
  app.add_option(
         "--calibration", slam.calibration,
         "The simulated robot is that of topobench calibrate with this seed, told what is right of it, "
         "what\ncalibration found, or nothing but setup; the drive is the same")
      ->needs("--simulate")
      ->excludes("--hardship")
      ->check(CLI::IsMember(topo::bench::calibration_names()));
  app.add_option("--minutes", slam.minutes, "Of the simulated patrol")
      ->needs("--simulate")
      ->capture_default_str()
      ->check(number_from(0.1, 600.0));
  app.add_option("--seed", slam.seed, "Of route, noise, slip and wheel errors")
      ->needs("--simulate")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  app.add_option("--people", slam.people, "Who walk about in the building")
      ->needs("--simulate")
      ->capture_default_str()
      ->check(CLI::Range(0, 100));
  app.add_option("--acceleration", slam.acceleration_mps2, "Of the simulated robot, m/s^2")
      ->needs("--simulate")
      ->capture_default_str()
      ->check(number_from(0.05, 5.0));
  app.add_option("--out", slam.out, "Folder for map.pgm, map.yaml, map.png and trajectory.txt")
      ->check(not_empty());
  app.add_flag("--json", slam.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::ExploreCommand& explore) {
  app.add_option("--world", explore.world, "The building: a map_server YAML file or a drawn scene (.toml)")
      ->required();
  app.add_option("--robots", explore.robots, "How many robots enter at the start, 1 to 8")
      ->capture_default_str();
  app.add_option(
         "--strategy", explore.strategy,
         "topometric_no_walls: without the wall store; topometric_kmeans: a team shares out the "
         "paper's\nclusters of goals, not by travel; topometric_no_kmeans: the same with single goals; "
         "topometric_gaps_in_turn: no gap\nis filled at once; topometric_all_looks: the final sweep leaves "
         "nothing out; topometric_stays_out: no robot goes\nhome before the others have no goals;\n"
         "topometric_no_places: the free space is not divided, every opening is a goal")
      ->check(CLI::IsMember(topo::bench::contender_names()))
      ->capture_default_str();
  app.add_option("--seed", explore.seed, "Of noise, slip and wheel errors")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  app.add_option("--fidelity", explore.fidelity,
                 "full: every scan, and SLAM; plan: 5 Hz, 270 beams, the true pose with a bounded error, "
                 "control at 10 Hz,\n"
                 "places in cells of 0.1 m, and a quiet way thought over every 4 s")
      ->check(CLI::IsMember({"full", "plan"}))
      ->capture_default_str();
  app.add_option("--finish", explore.finish,
                 "essential: home when the paper's goals are visited, and no gap leads on to 10 m2 or more;\n"
                 "worth:RATE: without what gives less than RATE m2 for a second of the way there")
      ->check(topo::bench::finish_form())
      ->capture_default_str();
  app.add_option("--limit", explore.limit_s, "Seconds of the robot's time")->capture_default_str();
  app.add_option(
         "--radio", explore.radio,
         "Of several robots: perfect, none, or items joined by +: range:M (metres), loss:P (share of\n"
         "datagrams), delay:S (seconds), cut:FROM:TO (seconds)")
      ->capture_default_str();
  app.add_option(
         "--contact", explore.contact_lost_s,
         "Of several robots: who has heard of no other for so many seconds goes back to where it last "
         "did, then on; 0: never")
      ->check(number_from(0.0, 1e6))
      ->capture_default_str();
  app.add_option("--speed", explore.v_max_mps,
                 "Most metres a second of a robot (base.v_max_mps), up to the 1.2 of a P3-DX")
      ->capture_default_str();
  app.add_option("--entry-delay", explore.entry_delay_s,
                 "Of several robots: seconds from one's beginning to the next one's")
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--starts", [&](const std::string& word) { explore.starts_known = word == "known"; },
         "Of several robots, to themselves: unknown (fidelity full) has them find each other in their maps")
      ->check(CLI::IsMember({"known", "unknown"}))
      ->default_str("known");
  app.add_option("--start", explore.start, "X,Y,THETA in metres and radians; else the world's first")
      ->delimiter(',');
  app.add_option(
         "--calibration", explore.calibration,
         "One robot as topobench calibrate has it, with this seed; its configuration is right, as found "
         "by\ncalibration, or none: as set up")
      ->check(CLI::IsMember(topo::bench::calibration_names()));
  app.add_flag("--bound", explore.bound,
               "The way to 99 % over that of robots that know the building (topobench bound)");
  app.add_option("--out", explore.out, "Folder for pictures, decisions, path and map")->check(not_empty());
  app.add_flag("--json", explore.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::JudgeCommand& judge) {
  app.add_option("--world", judge.world, "The building, as toposim --world has it")->required();
  app.add_option("--map", judge.map, "map.yaml that topoctl map save wrote; trajectory.txt lies beside it")
      ->required();
  app.add_option("--truth", judge.truth, "What toposim --truth wrote")->required();
  app.add_option("--start", judge.start,
                 "X,Y,THETA of the map's origin in the building; else the first true pose")
      ->delimiter(',');
  app.add_option("--picture", judge.picture, "PNG of walls, covered area and path");
  app.add_flag("--json", judge.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::AnalyseCommand& analyse) {
  app.add_option("--map", analyse.map, "map_server YAML file, or a picture alone (PNG, PGM)")->required();
  app.add_option("--resolution", analyse.resolution_m, "Metres a pixel, of a picture alone (0.05)");
  app.add_option("--repeat", analyse.repeat, "How often, for the times")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--out", analyse.out, "Folder for labels.png, overlay.png, places.geojson, compass.png")
      ->check(not_empty());
  app.add_flag("--json", analyse.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::CompassCommand& compass) {
  app.add_option("--maps", compass.maps, "map_server YAML files, and folders of them")
      ->required()
      ->delimiter(',');
  app.add_option("--turns", compass.turns_deg, "Degrees, counter-clockwise")
      ->delimiter(',')
      ->capture_default_str()
      ->check(number_from(-360.0, 360.0));
  app.add_flag("--beside", compass.beside,
               "Each map beside itself turned, in one map: the directions of two wings\n"
               "(turns within 5 degrees of a quarter turn are of one direction)");
  app.add_flag("--json", compass.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::CalibrateCommand& calibrate) {
  app.footer(
      "Front scanner turned by 7 degrees and 4 cm off, coronal one rolled by 3 degrees and 4 cm off, wheels "
      "4 %\n"
      "and track 8 % wrong, status packets 60 ms late; of odd seeds the scanners' names are exchanged. The\n"
      "dialogue of topoctl setup, three minutes by hand in a furnished room, topoctl calibrate.");
  app.add_option("--seeds", calibrate.seeds, "Of noise, slip, and the signs of the wheels' errors: 1 to this")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_flag("--json", calibrate.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::ContactCommand& contact) {
  topo::bench::ContactSetup& setup = contact.setup;
  app.add_option("--robots", setup.robots)->check(CLI::Range(2, 16))->capture_default_str();
  app.add_option("--keyframes", setup.keyframes, "That each made while apart; an hour is 5600")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--loss", setup.loss, "Share of datagrams, for each receiver by itself")
      ->check(number_from(0.0, 0.95))
      ->capture_default_str();
  app.add_option("--delay", setup.delay_s, "Seconds that a datagram takes")
      ->check(number_from(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--catch-up", setup.rates.catch_up_bytes_per_s,
                 "Bytes a second that a robot may send while mates lack much")
      ->check(number_from(1e3, 1e9))
      ->capture_default_str();
  app.add_flag("--unicast", setup.rates.unicast, "Each datagram is charged once for each mate");
  app.add_option("--limit", setup.limit_s, "Seconds after contact")->capture_default_str();
  app.add_option("--steady", setup.steady_s, "Seconds for which all go on, afterwards")
      ->capture_default_str();
  app.add_option("--seed", setup.seed, "Of contents, loss and jitter")->capture_default_str();
  app.add_flag("--json", contact.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::GoalsCommand& goals) {
  app.footer(
      "Clusters and goals are those of maps with eight frontier clusters (0.75 m) or more, openings those "
      "of\n"
      "all maps. An opening onto space: a cluster through which the robot can drive into 10 m2 or more that\n"
      "its map does not know. It is without a goal when none has its own opening there or sees it from\n"
      "within 3 m.");
  app.add_option("--worlds", goals.worlds,
                 "Buildings: files as explore --world has them, and folders of them")
      ->required()
      ->delimiter(',');
  app.add_option("--seeds", goals.seeds, "Explorations of each, from starts as explore-table draws them")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--stages", goals.stages, "Maps of each exploration, evenly over the area known")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--fidelity", goals.fidelity)->check(CLI::IsMember({"full", "plan"}))->capture_default_str();
  app.add_option("--out", goals.out, "Folder for pictures of the maps where an opening is without a goal")
      ->check(not_empty());
  app.add_flag("--json", goals.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::SessionCommand& session) {
  app.add_option("--log", session.log, "The log")->required();
  add_beams(app, session.beams_deg);
  app.add_option("--out", session.out, "File for the session, as topoctl session save writes it")
      ->check(not_empty());
  app.add_option("--localise", session.localise, "Scans of the log that are looked for in its whole map")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000000));
  app.add_flag("--json", session.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::SegmentCommand& segment) {
  app.add_option("labels,--labels", segment.labels, "Folder of label pictures")->required();
  app.add_option("truth,--truth", segment.truth, "Folder of true rooms (lines or colours)")->required();
  app.add_option("--maps", segment.maps, "Folder of maps to analyse first, into the folder of labels");
  app.add_option("--resolution", segment.resolution_m, "Metres a pixel, of these maps")
      ->capture_default_str();
  app.add_option("--turn", segment.turn_deg, "Degrees by which the truth is turned against the maps")
      ->capture_default_str();
  app.add_option(
         "--set", segment.set,
         "NAME VALUE: a parameter of the segmentation (PlaceParams), of the maps to analyse: density.min 0.6")
      ->needs("--maps");
  app.add_flag("--json", segment.json, "One JSON object on one line");
}

void add_options(CLI::App& app, topo::bench::PosegraphCommand& posegraph) {
  app.add_option("file", posegraph.file, "The graph: g2o or TORO text, .bz2 or .gz or plain")->required();
  app.add_flag("--robust", posegraph.robust, "Closures under the mapper's robust loss, not least squares");
  app.add_flag("--json", posegraph.json, "One JSON object on one line");
}

int finish(const topo::types::Status& done) {
  if (done) return 0;
  fmt::print(stderr, "topobench: {}\n", done.error().message);
  return exit_status(done.error());
}

int start(int argc, char** argv) {
  CLI::App app{"topobench: what Topometric's parts do on recorded data"};
  app.require_subcommand(1);

  topo::bench::SlamCommand slam;
  CLI::App* slam_app = app.add_subcommand(
      "slam", "Map a CARMEN log (.clf, .clf.bz2, .clf.gz), a Mines URG log (.dat.bz2) or a simulated patrol");
  add_options(*slam_app, slam);

  topo::bench::AnalyseCommand analyse;
  CLI::App* analyse_app = app.add_subcommand("analyse", "The topometric analysis of one map");
  add_options(*analyse_app, analyse);
  topo::bench::SegmentCommand segment;
  CLI::App* segment_app = app.add_subcommand("segment", "Score place maps against true rooms");
  add_options(*segment_app, segment);
  topo::bench::ExploreCommand explore;
  CLI::App* explore_app =
      app.add_subcommand("explore", "Explore a simulated building in lock-step, faster than real time");
  explore_app->footer(
      "Coverage, covered and t50_s to t99_s: share of the reachable area that the map knows, as free or as\n"
      "occupied. free and t_free_s: as free, which the rim of the walls, where hits fall, never is. The\n"
      "reachable area is what a scanner sees from wherever the robot's disc can get to from its start.\n"
      "decision_ms: finding goals, their costs and whose they are; planning_ms: all of a period that "
      "decides,\n"
      "from the map to the route. CPU time.");
  add_options(*explore_app, explore);
  topo::bench::TableCommand table;
  CLI::App* table_app = app.add_subcommand(
      "explore-table", "Explore many buildings in many ways, and hold the ways against each other");
  table_app->footer(
      "Can be stopped at any time: the same command goes on where it was. A run that crashed is tried "
      "again.");
  add_options(*table_app, table);
  topo::bench::CompassCommand compass;
  CLI::App* compass_app = app.add_subcommand(
      "compass", "The direction of turned maps against that of the maps: how far the compass is off");
  add_options(*compass_app, compass);
  topo::bench::CalibrateCommand calibrate;
  CLI::App* calibrate_app = app.add_subcommand(
      "calibrate", "Set up and calibrate simulated robots: how far the values are off that it finds");
  add_options(*calibrate_app, calibrate);
  topo::bench::CanonicalCommand canonical;
  CLI::App* canonical_app = app.add_subcommand(
      "canonical", "Hashes of saved sessions of a team: of keyframes, relations, and the maps they make");
  canonical_app->add_option("sessions", canonical.sessions, "Files that topoctl session save wrote")
      ->required();
  topo::bench::ContactCommand contact;
  CLI::App* contact_app = app.add_subcommand(
      "contact", "How long robots that were apart take to have the same sets, and what they send afterwards");
  add_options(*contact_app, contact);
  topo::bench::GoalsCommand goals;
  CLI::App* goals_app = app.add_subcommand(
      "goals", "Goals on partial maps met while exploring: how few, and whether one is missing");
  add_options(*goals_app, goals);
  topo::bench::BoundCommand bound;
  CLI::App* bound_app =
      app.add_subcommand("bound", "The least way of robots that know the building, from below and above");
  add_options(*bound_app, bound);
  topo::bench::SuiteCommand suite;
  CLI::App* suite_app =
      app.add_subcommand("suite", "Draw buildings that nobody tuned for, and say what they are like");
  add_options(*suite_app, suite);
  topo::bench::SessionCommand session;
  CLI::App* session_app = app.add_subcommand(
      "session", "Size of a log's session on the disk, and how its scans are found in its whole map");
  add_options(*session_app, session);
  topo::bench::JudgeCommand judge;
  CLI::App* judge_app =
      app.add_subcommand("judge",
                         "Hold a saved map against the building and the true path. `covered` is with the map "
                         "laid where its path fits best, `covered_at_start` with it laid on the true start");
  add_options(*judge_app, judge);
  topo::bench::PosegraphCommand posegraph;
  CLI::App* posegraph_app =
      app.add_subcommand("posegraph", "Solve a pose graph of the community's benchmarks from its odometry");
  add_options(*posegraph_app, posegraph);

  if (const auto ended = topo::daemon::parse_command_line(app, "topobench", argc, argv)) return *ended;
  if (*session_app) return finish(topo::bench::run_session(session));
  if (*slam_app) return finish(topo::bench::run_slam(slam));
  if (*analyse_app) return finish(topo::bench::run_analyse(analyse));
  if (*segment_app) return finish(topo::bench::run_segment(segment));
  if (*explore_app) return finish(topo::bench::run_explore(explore));
  if (*compass_app) return finish(topo::bench::run_compass(compass));
  if (*calibrate_app) return finish(topo::bench::run_calibrate(calibrate));
  if (*canonical_app) return finish(topo::bench::run_canonical(canonical));
  if (*contact_app) return finish(topo::bench::run_contact_command(contact));
  if (*goals_app) return finish(topo::bench::run_goals(goals));
  if (*bound_app) return finish(topo::bench::run_bound(bound));
  if (*suite_app) return finish(topo::bench::run_suite(suite));
  if (*table_app) return finish(topo::bench::run_table(table));
  if (*posegraph_app) return finish(topo::bench::run_posegraph(posegraph));
  return finish(topo::bench::run_judge(judge));
}

}  // namespace

int main(int argc, char** argv) { return topo::io::run_program("topobench", start, argc, argv); }
