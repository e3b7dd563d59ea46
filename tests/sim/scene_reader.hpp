// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tests/sim/shapes.hpp"

namespace topo::sim {

constexpr double kFar_m = 1000.0;  ///< limit of the coordinates of a building

/// Collects every fault of one file with its position.
class Faults {
 public:
  explicit Faults(std::string file) : file_(std::move(file)) {}
  void add(const toml::source_region& where, const std::string& what);
  [[nodiscard]] bool any() const { return !text_.empty(); }
  [[nodiscard]] const std::string& text() const { return text_; }  ///< one fault per line

 private:
  std::string file_;
  std::string text_;
};

/// Reads the keys of one table of a drawn scene; a fault is added to the faults, and `out` does not change.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string what, Faults& faults)
      : table_(table), what_(std::move(what)), faults_(faults) {}

  /// Adds a fault for every key that is not one of these.
  void allow(std::initializer_list<std::string_view> keys);
  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
  bool number(std::string_view key, bool required, double low, double high, double& out);
  bool range(std::string_view key, double low, double high, double& out_min,
             double& out_max);  ///< [min, max]
  bool point(std::string_view key, bool required, Vector2& out);
  bool points(std::string_view key, std::size_t least, std::vector<Vector2>& out);
  bool flag(std::string_view key, bool& out);
  bool word(std::string_view key, std::initializer_list<std::string_view> choices, std::string& out);
  bool text(std::string_view key, std::string& out);
  void fault(std::string_view key, const std::string& found_and_expected);

  [[nodiscard]] const toml::table& table() const { return table_; }
  [[nodiscard]] Faults& faults() { return faults_; }
  [[nodiscard]] const std::string& what() const { return what_; }

 private:
  bool read_number(const toml::node& node, std::string_view key, double low, double high, double& out);
  bool read_point(const toml::node& node, std::string_view key, Vector2& out);
  const toml::node* find(std::string_view key, bool required, std::string_view expected);

  const toml::table& table_;
  std::string what_;
  Faults& faults_;
};

}  // namespace topo::sim
