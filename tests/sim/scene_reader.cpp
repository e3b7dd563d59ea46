// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/scene_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace topo::sim {

namespace {

std::string shown(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return "'" + *text + "'";
  if (const auto value = node.value<double>()) return fmt::format("{:g}", *value);
  if (node.is_array()) return fmt::format("an array of {}", node.as_array()->size());
  return node.is_table() ? "a table" : "something else";
}

}  // namespace

void Faults::add(const toml::source_region& where, const std::string& what) {
  text_ += fmt::format("{}{}:{}:{}: {}", text_.empty() ? "" : "\n", file_, where.begin.line,
                       where.begin.column, what);
}

void TableReader::allow(std::initializer_list<std::string_view> keys) {
  for (const auto& [key, node] : table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    faults_.add(key.source(), fmt::format("{}: unknown key '{}'; expected one of {}", what_, key.str(),
                                          fmt::join(keys, ", ")));
  }
}

void TableReader::fault(std::string_view key, const std::string& found_and_expected) {
  const toml::node* node = table_.get(key);
  faults_.add(node != nullptr ? node->source() : table_.source(),
              fmt::format("{}: '{}' {}", what_, key, found_and_expected));
}

const toml::node* TableReader::find(std::string_view key, bool required, std::string_view expected) {
  const toml::node* node = table_.get(key);
  if (node == nullptr && required) fault(key, fmt::format("is missing; expected {}", expected));
  return node;
}

bool TableReader::read_number(const toml::node& node, std::string_view key, double low, double high,
                              double& out) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (value && std::isfinite(*value) && *value >= low && *value <= high) {
    out = *value;
    return true;
  }
  faults_.add(node.source(), fmt::format("{}: '{}' is {}; expected a number from {:g} to {:g}", what_, key,
                                         shown(node), low, high));
  return false;
}

bool TableReader::number(std::string_view key, bool required, double low, double high, double& out) {
  const toml::node* node = find(key, required, fmt::format("a number from {:g} to {:g}", low, high));
  return node != nullptr && read_number(*node, key, low, high, out);
}

bool TableReader::range(std::string_view key, double low, double high, double& out_min, double& out_max) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return false;
  const toml::array* pair = node->as_array();
  if (pair == nullptr || pair->size() != 2) {
    fault(key, fmt::format("is {}; expected [least, most] from {:g} to {:g}", shown(*node), low, high));
    return false;
  }
  double least = 0.0;
  double most = 0.0;
  const bool read =
      read_number((*pair)[0], key, low, high, least) && read_number((*pair)[1], key, low, high, most);
  if (!read) return false;
  if (least > most) {
    fault(key, fmt::format("is [{:g}, {:g}]; expected the smaller number first", least, most));
    return false;
  }
  out_min = least;
  out_max = most;
  return true;
}

bool TableReader::read_point(const toml::node& node, std::string_view key, Vector2& out) {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    faults_.add(node.source(),
                fmt::format("{}: '{}' has {}; expected a point [x, y] in metres", what_, key, shown(node)));
    return false;
  }
  return read_number((*pair)[0], key, -kFar_m, kFar_m, out.x()) &&
         read_number((*pair)[1], key, -kFar_m, kFar_m, out.y());
}

bool TableReader::point(std::string_view key, bool required, Vector2& out) {
  const toml::node* node = find(key, required, "a point [x, y] in metres");
  return node != nullptr && read_point(*node, key, out);
}

bool TableReader::points(std::string_view key, std::size_t least, std::vector<Vector2>& out) {
  const toml::node* node = find(key, true, "a list of points [x, y] in metres");
  if (node == nullptr) return false;
  const toml::array* list = node->as_array();
  if (list == nullptr || list->size() < least) {
    fault(key, fmt::format("is {}; expected {} points [x, y] or more", shown(*node), least));
    return false;
  }
  out.assign(list->size(), Vector2(0.0, 0.0));
  bool good = true;
  for (std::size_t i = 0; i < out.size(); ++i) good = read_point((*list)[i], key, out[i]) && good;
  return good;
}

bool TableReader::flag(std::string_view key, bool& out) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return false;
  if (const auto value = node->value_exact<bool>()) {
    out = *value;
    return true;
  }
  fault(key, fmt::format("is {}; expected true or false", shown(*node)));
  return false;
}

bool TableReader::text(std::string_view key, std::string& out) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return false;
  if (const auto value = node->value_exact<std::string>()) {
    out = *value;
    return true;
  }
  fault(key, fmt::format("is {}; expected a text", shown(*node)));
  return false;
}

bool TableReader::word(std::string_view key, std::initializer_list<std::string_view> choices,
                       std::string& out) {
  std::string value;
  if (!text(key, value)) return false;
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    fault(key, fmt::format("is '{}'; expected one of {}", value, fmt::join(choices, ", ")));
    return false;
  }
  out = value;
  return true;
}

}  // namespace topo::sim
