// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "daemon/config/trimmed.hpp"

namespace topo::daemon {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return lines;
}

/// "base" of "[base]  # comment"; nothing for other lines.
std::string_view section_of(std::string_view line) {
  line = trimmed(line);
  const auto end = line.find(']');
  if (!line.starts_with('[') || line.starts_with("[[") || end == std::string_view::npos) return {};
  return trimmed(line.substr(1, end - 1));
}

/// True for "key = ...", and for "# key = ..." when `commented`.
bool sets(std::string_view line, std::string_view key, bool commented) {
  line = trimmed(line);
  if (commented != line.starts_with('#')) return false;
  if (commented) line = trimmed(line.substr(1));
  if (!line.starts_with(key)) return false;
  return trimmed(line.substr(key.size())).starts_with('=');
}

/// Where the comment behind a value begins; a # within a string is none.
std::size_t comment_at(std::string_view line) {
  bool in_string = false;
  for (std::size_t i = line.find('='); i < line.size(); ++i) {
    if (line[i] == '"' && line[i - 1] != '\\') in_string = !in_string;
    if (line[i] == '#' && !in_string) return i;
  }
  return line.size();
}

/// The comment stays in its column where there is room.
std::string with_value(std::string_view line, std::string_view key, std::string_view value) {
  const std::size_t at = comment_at(line);
  std::string out = fmt::format("{} = {}", key, value);
  if (at == line.size()) return out;
  out.resize(std::max(out.size() + 1, at), ' ');
  return out.append(line.substr(at));
}

struct Lines {
  std::size_t first = 0, last = 0;  ///< of a section, behind its head
};

std::size_t end_of_section(const std::vector<std::string>& lines, std::size_t first) {
  std::size_t last = first;
  while (last < lines.size() && !trimmed(lines[last]).starts_with('[')) ++last;
  while (last > first && trimmed(lines[last - 1]).empty()) --last;
  return last;
}

Lines find_section(std::vector<std::string>& lines, std::string_view section) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (section_of(lines[i]) == section) return {i + 1, end_of_section(lines, i + 1)};
  lines.insert(lines.end(), {std::string(), fmt::format("[{}]", section)});
  return {lines.size(), lines.size()};
}

void apply(std::vector<std::string>& lines, const KeyEdit& edit) {
  const auto dot = edit.path.rfind('.');
  const std::string section = edit.path.substr(0, dot), key = edit.path.substr(dot + 1);
  const Lines range = find_section(lines, section);
  for (const bool commented : {false, true}) {
    for (std::size_t i = range.first; i < range.last; ++i) {
      if (!sets(lines[i], key, commented)) continue;
      lines[i] = with_value(lines[i], key, edit.value);
      return;
    }
  }
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(range.last),
               fmt::format("{} = {}", key, edit.value));
}

std::string joined(const std::vector<std::string>& lines) {
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace

std::string edited(std::string_view text, std::span<const KeyEdit> edits) {
  std::vector<std::string> lines = lines_of(text);
  for (const KeyEdit& edit : edits) apply(lines, edit);
  return joined(lines);
}

std::string without_section(std::string_view text, std::string_view section) {
  std::vector<std::string> lines = lines_of(text);
  bool within = false;
  for (std::string& line : lines) {
    if (trimmed(line).starts_with('[')) within = section_of(line) == section;
    const std::string_view said = trimmed(line);
    if (within && !said.empty() && !said.starts_with('#')) line.insert(0, "# ");
  }
  return joined(lines);
}

}  // namespace topo::daemon
