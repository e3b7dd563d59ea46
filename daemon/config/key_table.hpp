// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "daemon/config/configuration.hpp"

namespace topo::daemon {

// Kinds of keys by the values that they accept. `field` returns the key's field of a Configuration; for a
// default-constructed Configuration, its default.

struct RealKey {
  double& (*field)(Configuration&);
  double min;
  double max;
};
struct IntegerKey {
  int& (*field)(Configuration&);
  int min;
  int max;
};
struct SwitchKey {
  bool& (*field)(Configuration&);
};
struct TextKey {
  std::string& (*field)(Configuration&);
  std::string_view form;  ///< for messages: the accepted form
  bool (*accepts)(std::string_view);
};
struct ChoiceKey {
  void (*set)(Configuration&, std::size_t);
  std::size_t (*get)(const Configuration&);
  std::span<const std::string_view> names;
};
struct AddressKey {
  std::string& (*field)(Configuration&);
  bool may_be_can = false;  ///< true for the base; a scanner's data do not fit on a CAN bus
};
struct IntegerListKey {
  std::vector<int>& (*field)(Configuration&);
  int min;
  int max;
};
struct TextListKey {
  std::vector<std::string>& (*field)(Configuration&);
  std::string_view form;  ///< of one element, for messages
  bool (*accepts)(std::string_view);
  std::size_t longest;  ///< list
};
struct PoseKey {  ///< "unknown": no pose
  std::optional<types::Se2>& (*field)(Configuration&);
};
struct PolygonKey {  ///< an empty list of corners: no polygon
  std::optional<types::Polygon>& (*field)(Configuration&);
};
struct PolygonListKey {
  std::vector<types::Polygon>& (*field)(Configuration&);
};
struct SectorsKey {  ///< [[from, to], ...] in degrees
  types::Sectors& (*field)(Configuration&);
};
using KeyKind = std::variant<RealKey, IntegerKey, SwitchKey, TextKey, ChoiceKey, AddressKey, IntegerListKey,
                             TextListKey, PoseKey, PolygonKey, PolygonListKey, SectorsKey>;

/// One key of the configuration file.
struct KeySpec {
  std::string path;       ///< "scanner.front.x_m"
  std::string_view unit;  ///< empty when there is none
  bool required = false;  ///< when its section is present
  KeyKind kind;
  std::string_view doc;  ///< one line

  [[nodiscard]] std::string_view section() const;
  [[nodiscard]] std::string_view name() const;
};

/// All keys, section by section in the order of the documentation.
const std::vector<KeySpec>& key_table();

/// The accepted values: "a number from 0.05 to 2 (m/s)".
std::string expected_text(const KeySpec& key);

/// The key's value in `configuration`, as TOML.
std::string value_text(const KeySpec& key, const Configuration& configuration);

/// `text` as a TOML basic string.
std::string quoted(std::string_view text);

}  // namespace topo::daemon
