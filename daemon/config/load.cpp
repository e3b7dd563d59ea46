// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "daemon/config/consistency.hpp"
#include "daemon/config/key_table.hpp"
#include "daemon/config/masks.hpp"
#include "daemon/config/polygon.hpp"
#include "daemon/config/pose.hpp"
#include "daemon/config/suggest.hpp"
#include "daemon/config/syntax.hpp"
#include "drivers/io/make_connector.hpp"
#include "drivers/pioneer/base_connector.hpp"

namespace topo::daemon {
namespace {

Place to_place(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

/// A value of the file as text, short enough for a message.
std::string found_text(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "an array of tables";
  std::string text;
  if (const auto* string = node.as_string()) {
    text = quoted(string->get());
  } else if (const auto* array = node.as_array()) {
    text = fmt::format("a list of {} values", array->size());
  } else if (const auto* integer = node.as_integer()) {
    text = fmt::format("{}", integer->get());
  } else if (const auto* real = node.as_floating_point()) {
    text = fmt::format("{}", real->get());
  } else if (const auto* boolean = node.as_boolean()) {
    text = boolean->get() ? "true" : "false";
  } else {
    text = "a date or time";
  }
  constexpr std::size_t kLongest = 80;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

/// Stores a node's value in its field; on failure returns the reason when the expected values alone do not
/// explain it.
struct Store {
  Configuration& c;
  const toml::node& node;
  const toml::node*& blamed;  ///< the part of the node that is wrong, when it is known more exactly
  using Outcome = std::optional<std::string>;  ///< nothing: stored

  Outcome operator()(const RealKey& k) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value || !(*value >= k.min && *value <= k.max)) return "";
    k.field(c) = *value;
    return {};
  }
  Outcome operator()(const IntegerKey& k) const { return store_integer(node, k.min, k.max, k.field(c)); }
  Outcome operator()(const SwitchKey& k) const {
    if (!node.is_boolean()) return "";
    k.field(c) = node.as_boolean()->get();
    return {};
  }
  Outcome operator()(const TextKey& k) const {
    if (!node.is_string() || !k.accepts(node.as_string()->get())) return "";
    k.field(c) = node.as_string()->get();
    return {};
  }
  Outcome operator()(const ChoiceKey& k) const {
    if (!node.is_string()) return "";
    const std::string& text = node.as_string()->get();
    const auto name = std::find(k.names.begin(), k.names.end(), text);
    if (name == k.names.end()) return "";
    k.set(c, static_cast<std::size_t>(name - k.names.begin()));
    return {};
  }
  Outcome operator()(const AddressKey& k) const {
    if (!node.is_string()) return "";
    const std::string& address = node.as_string()->get();
    const auto connector = k.may_be_can ? pioneer::make_base_connector(address) : io::make_connector(address);
    if (!connector) return connector.error().message;
    k.field(c) = node.as_string()->get();
    return {};
  }
  Outcome operator()(const IntegerListKey& k) const {
    const auto* array = node.as_array();
    if (array == nullptr) return "";
    std::vector<int> values;
    for (const auto& element : *array) {
      int value = 0;
      if (store_integer(element, k.min, k.max, value)) return "found there " + found_text(element);
      values.push_back(value);
    }
    k.field(c) = values;
    return {};
  }
  Outcome operator()(const TextListKey& k) const {
    const auto* array = node.as_array();
    if (array == nullptr || array->size() > k.longest) return "";
    std::vector<std::string> values;
    for (const auto& element : *array) {
      const auto* text = element.as_string();
      if (text == nullptr || !k.accepts(text->get())) {
        blamed = &element;
        return "element " + std::to_string(values.size() + 1) + " is " + found_text(element);
      }
      values.push_back(text->get());
    }
    k.field(c) = std::move(values);
    return {};
  }
  Outcome operator()(const PoseKey& k) const {
    if (!read_pose(node, k.field(c))) return "";
    return {};
  }

  Outcome operator()(const SectorsKey& k) const {
    if (!read_sectors(node, k.field(c))) return "";
    return {};
  }
  Outcome operator()(const PolygonKey& k) const {
    if (const auto* list = node.as_array(); list != nullptr && list->empty())
      return k.field(c).reset(), Outcome{};
    types::Polygon polygon;
    if (const auto fault = read_polygon(node, polygon)) return blame(*fault);
    k.field(c) = std::move(polygon);
    return {};
  }
  Outcome operator()(const PolygonListKey& k) const {
    const auto* list = node.as_array();
    if (list == nullptr) return "";
    std::vector<types::Polygon> polygons(list->size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      if (const auto fault = read_polygon(*list->get(i), polygons[i])) return blame(*fault);
    }
    k.field(c) = std::move(polygons);
    return {};
  }

  Outcome blame(const PolygonFault& fault) const {
    blamed = fault.where;
    return fault.what;
  }
  static Outcome store_integer(const toml::node& from, int min, int max, int& to) {
    const auto* integer = from.as_integer();
    if (integer == nullptr || integer->get() < min || integer->get() > max) return "";
    to = static_cast<int>(integer->get());
    return {};
  }
};

class Reader {
 public:
  explicit Reader(LoadedConfiguration& loaded) : loaded_(loaded) {}

  void read(const ParsedToml& parsed) {
    for (const auto& key : key_table()) {
      note_section(std::string(key.section()));
    }
    sections_[""] = to_place(parsed.root.source());
    present_.push_back("");
    walk(parsed.root, "");
    mark_optional_sections();
    check_missing(parsed.left_out);
  }

 private:
  void note_section(std::string section) {
    while (!section.empty()) {
      sections_.try_emplace(section);
      const std::size_t dot = section.rfind('.');
      section = dot == std::string::npos ? "" : section.substr(0, dot);
    }
  }

  void walk(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string path = prefix + std::string(key.str());
      const auto spec = std::find_if(key_table().begin(), key_table().end(),
                                     [&path](const KeySpec& s) { return s.path == path; });
      if (spec != key_table().end()) {
        read_value(*spec, key, node);
      } else if (sections_.contains(path)) {
        read_section(path, key, node);
      } else {
        fault(to_place(key.source()), unknown_text(path, prefix, node));
      }
    }
  }

  void read_section(const std::string& path, const toml::key& key, const toml::node& node) {
    present_.push_back(path);
    sections_[path] = to_place(key.source());
    if (const auto* table = node.as_table()) {
      walk(*table, path + ".");
    } else {
      fault(to_place(key.source()),
            fmt::format("{}: found {}, expected a section [{}]", path, found_text(node), path));
    }
  }

  void read_value(const KeySpec& spec, const toml::key& key, const toml::node& node) {
    loaded_.places[spec.path] = to_place(key.source());
    const toml::node* blamed = &node;
    const auto outcome = std::visit(Store{loaded_.values, node, blamed}, spec.kind);
    if (!outcome) return;
    if (std::holds_alternative<AddressKey>(spec.kind) && !outcome->empty()) {
      fault(to_place(node.source()),
            spec.path + ": " + *outcome);  // gives the value found and the expected form
      return;
    }
    fault(to_place(blamed->source()),
          fmt::format("{}: found {}, expected {}{}{}", spec.path, found_text(node), expected_text(spec),
                      outcome->empty() ? "" : ": ", *outcome));
  }

  std::string unknown_text(const std::string& path, const std::string& prefix, const toml::node& node) const {
    const std::string kind = node.is_table() ? "section" : "key";
    std::vector<std::string_view> here;
    for (const auto& spec : key_table()) {
      const std::string_view all = spec.path;
      if (all.starts_with(prefix))
        here.push_back(all.substr(prefix.size(), all.find('.', prefix.size()) - prefix.size()));
    }
    const std::string_view name = std::string_view(path).substr(prefix.size());
    const auto near = nearest(name, here);
    std::string text = fmt::format("{}: unknown {}", quoted(path), kind);
    if (!near.empty()) return text + fmt::format(", did you mean {}{}?", prefix, near);
    for (const auto& spec : key_table()) {
      if (spec.name() == name) return text + fmt::format(", did you mean {}?", spec.path);
    }
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
    return text + fmt::format(", expected one of {}", fmt::join(here, ", "));
  }

  bool present(std::string_view section) const {
    return std::find(present_.begin(), present_.end(), section) != present_.end();
  }

  void mark_optional_sections() {
    loaded_.values.front.present = present("scanner.front");
    loaded_.values.coronal.present = present("scanner.coronal");
    loaded_.values.team.present = present("team");
    // A team's robot is numbered once; where both numbers stand, check_consistency() compares them.
    if (loaded_.values.team.present && !loaded_.places.contains("robot.id") &&
        loaded_.places.contains("team.id"))
      loaded_.values.robot.id = loaded_.values.team.id;
  }

  /// The sections of the coronal scanner and of the team may be missing; every other section with a required
  /// key may not. A key on an unreadable line does not count as missing.
  void check_missing(const std::vector<std::string>& left_out) {
    for (const auto& key : key_table()) {
      if (!key.required || loaded_.places.contains(key.path)) continue;
      const std::string section(key.section());
      if (std::find(left_out.begin(), left_out.end(), key.name()) != left_out.end()) continue;
      if ((section == "scanner.coronal" || section == "team") && !present(section)) continue;
      Place place = sections_[section];
      if (place.line == 0) place = {1, 1};
      fault(place, fmt::format("{} is missing, expected {} ({})", key.path, expected_text(key), key.doc));
    }
  }

  void fault(Place place, std::string message) { loaded_.faults.push_back({place, std::move(message)}); }

  LoadedConfiguration& loaded_;
  std::map<std::string, Place> sections_;  ///< all possible sections, with their positions in the file
  std::vector<std::string> present_;
};

}  // namespace

LoadedConfiguration parse_configuration(std::string_view text, std::string file) {
  LoadedConfiguration loaded;
  loaded.file = std::move(file);
  const ParsedToml parsed = parse_toml(text);
  loaded.faults = parsed.faults;
  if (parsed.complete) {
    Reader(loaded).read(parsed);
    check_consistency(loaded);
  }
  std::sort(loaded.faults.begin(), loaded.faults.end());
  return loaded;
}

types::Result<LoadedConfiguration> load_configuration(const std::string& file) {
  constexpr std::streamsize kLargest = 1 << 20;  // a larger file is not a configuration
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    const int error = errno;
    const auto code = error == ENOENT   ? types::Errc::kNotFound
                      : error == EACCES ? types::Errc::kPermission
                                        : types::Errc::kIo;
    return types::fail(code, fmt::format("{}: {}; expected a configuration file", file, std::strerror(error)),
                       error);
  }
  std::string text(static_cast<std::size_t>(kLargest) + 1, '\0');
  in.read(text.data(), kLargest + 1);
  if (in.bad())
    return types::fail(types::Errc::kIo, file + ": cannot be read; expected a configuration file");
  if (in.gcount() > kLargest)
    return types::fail(types::Errc::kInvalidInput,
                       file + ": larger than 1 MiB; expected a configuration file");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse_configuration(text, file);
}

}  // namespace topo::daemon
