// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "daemon/app/version.hpp"
#include "daemon/config/suggest.hpp"

namespace topo::daemon {
namespace {

constexpr int kWrong = 2;

/// The word found in the place of a subcommand, and the accepted ones; empty when there is no such word.
std::string misspelt_command(const CLI::App& cli) {
  const CLI::App* last = &cli;  // the command that lacks its subcommand
  while (!last->get_subcommands().empty()) last = last->get_subcommands().back();
  const std::vector<std::string> words = cli.remaining(true);
  if (last->get_require_subcommand_min() == 0 || words.empty()) return {};
  std::vector<std::string_view> names;
  for (const CLI::App* sub : last->get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  const std::string_view near = nearest(words.front(), names);
  return fmt::format("found \"{}\", expected one of {}{}", words.front(), fmt::join(names, ", "),
                     near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

}  // namespace

std::optional<int> parse_command_line(CLI::App& cli, const std::string& program, int argc, char** argv) {
  cli.set_version_flag("--version", program + " " + kVersion, "print the version and exit");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (const std::string misspelt = misspelt_command(cli); !misspelt.empty()) {
      fmt::print(stderr, "{}: {}\n", program, misspelt);
    } else {
      cli.exit(error);
    }
    return kWrong;
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? 0 : kWrong;
  }
  return {};
}

CLI::Validator number_from(double low, double high) {
  const auto fault = [low, high](const std::string& text) {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return std::string();
    return fmt::format("found {}, expected a number from {} to {}", text, low, high);
  };
  return {fault, fmt::format("FLOAT in [{} - {}]", low, high)};
}

}  // namespace topo::daemon
