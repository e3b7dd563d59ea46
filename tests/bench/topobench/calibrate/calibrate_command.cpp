// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/calibrate/calibrate_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bench/topobench/calibrate/calibration_error.hpp"

namespace topo::bench {
namespace {

struct Row {
  std::uint64_t seed = 0;
  int answers = 0;
  bool told_apart = false;
  Errors errors{};
};

std::string cells(const Errors& values) {
  std::string text;
  for (const double value : values) text += fmt::format(" {:.3g} |", value);
  return text;
}

void print_text(const std::vector<Row>& rows, const Errors& worst) {
  std::string head = "| seed | answers | told apart |", line = "| --- | --- | --- |";
  Errors must{}, better{};
  for (std::size_t i = 0; i < kErrorKinds.size(); ++i) {
    head += fmt::format(" {}, {} |", kErrorKinds[i].name, kErrorKinds[i].unit);
    line += " --- |";
    must[i] = kErrorKinds[i].must;
    better[i] = 0.5 * kErrorKinds[i].must;
  }
  fmt::print("{}\n{}\n", head, line);
  for (const Row& row : rows)
    fmt::print("| {} | {} | {} |{}\n", row.seed, row.answers, row.told_apart ? "yes" : "no",
               cells(row.errors));
  fmt::print("| worst | | |{}\n| must | | |{}\n| stretch | | |{}\n", cells(worst), cells(must),
             cells(better));
}

nlohmann::json json_of(const Errors& errors) {
  nlohmann::json out;
  for (std::size_t i = 0; i < kErrorKinds.size(); ++i)
    out[fmt::format("{} {}", kErrorKinds[i].name, kErrorKinds[i].unit)] = errors[i];
  return out;
}

void print_json(const std::vector<Row>& rows, const Errors& worst) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows)
    list.push_back({{"seed", row.seed},
                    {"answers", row.answers},
                    {"told_apart", row.told_apart},
                    {"errors", json_of(row.errors)}});
  fmt::print("{}\n", nlohmann::json{{"robots", list}, {"worst", json_of(worst)}}.dump());
}

/// The first thing that is not as it must be.
types::Status judged(const std::vector<Row>& rows, const Errors& worst) {
  for (const Row& row : rows)
    if (!row.told_apart)
      return types::fail(types::Errc::kProtocol,
                         fmt::format("calibrate: seed {}: setup took one scanner for the other", row.seed));
  for (std::size_t i = 0; i < kErrorKinds.size(); ++i)
    if (!(worst[i] <= kErrorKinds[i].must))
      return types::fail(
          types::Errc::kProtocol,
          fmt::format("calibrate: {} is off by {:.3g} {}, expected at most {:g}", kErrorKinds[i].name,
                      worst[i], kErrorKinds[i].unit, kErrorKinds[i].must));
  return {};
}

}  // namespace

types::Status run_calibrate(const CalibrateCommand& command) {
  std::vector<Row> rows;
  Errors worst{};
  for (std::uint64_t seed = 1; seed <= command.seeds; ++seed) {
    const auto robot = calibrated_robot(seed);
    if (!robot) return tl::unexpected(robot.error());
    rows.push_back({seed, robot->set_up.answers, robot->set_up.told_apart, errors_of(*robot)});
    for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], rows.back().errors[i]);
  }
  command.json ? print_json(rows, worst) : print_text(rows, worst);
  return judged(rows, worst);
}

}  // namespace topo::bench
