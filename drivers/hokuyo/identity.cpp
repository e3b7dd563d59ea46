// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/identity.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>
#include <string>

#include "drivers/hokuyo/range_decoder.hpp"

namespace topo::hokuyo {
namespace {

using types::Errc;
using types::fail;
using types::Status;

/// "KEY:value;c".
struct KeyLine {
  std::string_view key;
  std::string_view value;
  bool good = false;  ///< the check character matches one of the variants that sensors compute
};

/// The sum covers the text before the semicolon; some firmware includes the semicolon, and some stops at "<-"
/// (PROTOCOLS section 9).
bool check_fits(std::string_view text, std::string_view with_semicolon, char check) {
  if (checksum(text) == check || checksum(with_semicolon) == check) return true;
  const std::size_t arrow = text.find("<-");
  return arrow != std::string_view::npos && checksum(text.substr(0, arrow)) == check;
}

std::optional<KeyLine> split(std::string_view line) {
  if (line.size() < 2 || line[line.size() - 2] != ';') return std::nullopt;
  const std::string_view text = line.substr(0, line.size() - 2);
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  return KeyLine{text.substr(0, colon), text.substr(colon + 1),
                 check_fits(text, line.substr(0, line.size() - 1), line.back())};
}

std::optional<KeyLine> find(const Reply& reply, std::string_view key) {
  for (std::size_t i = 0; i < reply.lines(); ++i) {
    const auto line = split(reply.line(i));
    if (line && line->key == key) return line;
  }
  return std::nullopt;
}

std::string good_value(const Reply& reply, std::string_view key) {
  const auto line = find(reply, key);
  const auto printable = [](char c) { return c >= 0x20 && c <= 0x7E; };  // for use in messages
  const bool usable = line && line->good && std::all_of(line->value.begin(), line->value.end(), printable);
  return usable ? std::string(line->value) : std::string();
}

bool is_serial(std::string_view text) {
  return !text.empty() && text.size() <= 16 && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
  });
}

struct NumberField {
  std::string_view key;
  int SensorInfo::*member;
  int min, max;
};

/// Steps are bounded by the four decimal digits of a request, ranges by three characters of six bits.
constexpr NumberField kNumberFields[] = {
    {"DMIN", &SensorInfo::distance_min_mm, 0, 262143},
    {"DMAX", &SensorInfo::distance_max_mm, 1, 262143},
    {"ARES", &SensorInfo::steps_per_turn, 1, 100000},
    {"AMIN", &SensorInfo::step_min, 0, 9999},
    {"AMAX", &SensorInfo::step_max, 0, 9999},
    {"AFRT", &SensorInfo::step_front, 0, 9999},
    {"SCAN", &SensorInfo::rpm, 1, 60000},
};

Status read_number(const Reply& reply, const NumberField& field, SensorInfo& info) {
  const std::string name(field.key);
  const auto line = find(reply, field.key);
  if (!line) return fail(Errc::kProtocol, "the sensor's parameters (PP) lack " + name);
  if (!line->good)
    return fail(Errc::kProtocol, "wrong checksum on " + name + " in the sensor's parameters (PP)");
  int value = 0;
  const char* const end = line->value.data() + line->value.size();
  const auto [stop, error] = std::from_chars(line->value.data(), end, value);
  if (error != std::errc{} || stop != end || value < field.min || value > field.max) {
    return fail(Errc::kUnsupported, "the sensor's parameter " + name + " is \"" + std::string(line->value) +
                                        "\"; expected " + std::to_string(field.min) + " to " +
                                        std::to_string(field.max));
  }
  info.*field.member = value;
  return {};
}

}  // namespace

Family family_of(std::string_view product) {
  const auto has = [&](std::string_view part) { return product.find(part) != std::string_view::npos; };
  if (has("UTM-30LX-EW")) return Family::kUtmEw;
  if (has("UTM-30LX")) return Family::kUtm;
  if (has("UST-")) return Family::kUst;
  if (has("URG-04LX") || has("UBG-04LX") || has("UHG-08LX")) return Family::kUrg;
  return Family::kUnknown;
}

bool is_listed(std::string_view product) {
  constexpr std::string_view kListed[] = {"UTM-30LX-EW", "UTM-30LX",      "UST-10LX",     "UST-20LX",
                                          "URG-04LX",    "URG-04LX-UG01", "UBG-04LX-F01", "UHG-08LX"};
  return std::any_of(std::begin(kListed), std::end(kListed), [&](std::string_view name) {
    const std::size_t at = product.find(name);
    if (at == std::string_view::npos) return false;
    const std::string_view rest = product.substr(at + name.size());  // "UST-10LXFA" is another model
    return rest.empty() || rest.front() == ' ' || rest.front() == '(';
  });
}

int cluster_of(const SensorInfo& info) {
  constexpr int kMost = static_cast<int>(types::Scan::kMaxBeams);
  return (info.step_max - info.step_min) / kMost + 1;
}

std::string assumption(const SensorInfo& info) {
  if (is_listed(info.product)) return {};
  std::string text = "the model \"" + info.product + "\" is not known: ";
  text += family_of(info.product) == Family::kUnknown
              ? "below " + std::to_string(std::max(info.distance_min_mm, RangeDecoder::kLeast_mm)) +
                    " mm it measured nothing"
              : "its codes are those of its family";
  const int cluster = cluster_of(info);
  if (cluster > 1)
    text += ", " + std::to_string(info.step_max - info.step_min + 1) + " steps come " +
            std::to_string(cluster) + " by " + std::to_string(cluster);
  return text;
}

bool has_intensity(Family family) {
  return family == Family::kUtm || family == Family::kUtmEw || family == Family::kUst;
}

Status read_version(const Reply& reply, SensorInfo& info) {
  info.vendor = good_value(reply, "VEND");
  info.product = good_value(reply, "PROD");
  info.firmware = good_value(reply, "FIRM");
  info.protocol = good_value(reply, "PROT");
  if (info.product.empty())
    return fail(Errc::kProtocol, "the sensor's version reply (VV) has no readable product name (PROD)");
  const auto serial = find(reply, "SERI");
  // Some URG-04LX firmware sends this one line with a wrong check character (section 13).
  const bool tolerated = serial && family_of(info.product) == Family::kUrg;
  if (!serial || !(serial->good || tolerated))
    return fail(Errc::kProtocol, "the sensor's version reply (VV) has no readable serial number (SERI)");
  if (!is_serial(serial->value))
    return fail(Errc::kUnsupported,
                "the sensor's serial number (SERI) is no text of 1 to 16 letters, digits, "
                "- _ .");
  info.serial_number = std::string(serial->value);
  if (info.serial_number.front() == '0') info.serial_number.front() = 'H';
  return {};
}

Status read_parameters(const Reply& reply, SensorInfo& info) {
  info.model = good_value(reply, "MODL");
  for (const NumberField& field : kNumberFields) {
    if (Status read = read_number(reply, field, info); !read) return read;
  }
  const int beams = info.step_max - info.step_min + 1;
  const auto steps = std::to_string(info.step_min) + ".." + std::to_string(info.step_max);
  if (beams < 1 || beams > info.steps_per_turn) {
    return fail(Errc::kUnsupported, "the sensor's steps (AMIN..AMAX) are " + steps + " of " +
                                        std::to_string(info.steps_per_turn) +
                                        " a turn (ARES); expected one step or more, within one turn");
  }
  if (info.step_front < info.step_min || info.step_front > info.step_max) {
    return fail(Errc::kUnsupported, "the sensor's front step (AFRT) is " + std::to_string(info.step_front) +
                                        "; expected it within " + steps);
  }
  if (info.distance_max_mm <= info.distance_min_mm) {
    return fail(Errc::kUnsupported,
                "the sensor's range (DMIN..DMAX) is " + std::to_string(info.distance_min_mm) + ".." +
                    std::to_string(info.distance_max_mm) + " mm; expected DMIN below DMAX");
  }
  return {};
}

void read_state(const Reply& reply, SensorInfo& info) {
  const std::string status = good_value(reply, "STAT");
  if (!status.empty()) info.status = status;
}

std::optional<std::uint32_t> read_time(const Reply& reply) {
  if (reply.lines() != 1) return std::nullopt;
  const auto text = checked(reply.line(0));
  if (!text || text->size() != 4) return std::nullopt;
  return decode_number(*text);
}

bool same_serial(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto normal = [i](char c) {
      const int upper = std::toupper(static_cast<unsigned char>(c));
      return i == 0 && upper == '0' ? 'H' : upper;
    };
    if (normal(a[i]) != normal(b[i])) return false;
  }
  return true;
}

std::string_view describe_status(std::string_view status) {
  if (status.size() != 2) return "answer of SCIP 1.1";
  if (status == "0L") return "abnormal state, laser stopped";
  if (status == "0I") return "firmware update mode";
  if (status == "10") return "refused in the present state";
  if (status == "98") return "measuring again after a recovered error";
  if (status[0] == '0' && status[1] >= 'A') return "the sensor does not take this command";
  if (status[0] == '0') return "refused parameter";
  if (status >= "21" && status <= "49") return "measuring stopped to check an error";
  if (status >= "50" && status <= "97") return "hardware trouble (laser, motor or temperature)";
  return "unknown status";
}

}  // namespace topo::hokuyo
