// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/scip_models.hpp"

#include <array>

namespace topo::sim {
namespace {

constexpr ScipModelSpec kUtm30LxSpec{.model = ScipModel::kUtm30Lx,
                                     .name = "UTM-30LX",
                                     .vendor = "Hokuyo Automatic Co.,Ltd.",
                                     .product = "SOKUIKI Sensor TOP-URG UTM-30LX",
                                     .firmware = "1.16.01(16/Nov./2009)",
                                     .protocol = "SCIP 2.0",
                                     .modl = "UTM-30LX(Hokuyo Automatic Co.,Ltd.)",
                                     .dmin_mm = 23,
                                     .dmax_mm = 60000,
                                     .ares = 1440,
                                     .amin = 0,
                                     .amax = 1080,
                                     .afrt = 540,
                                     .scan_rpm = 2400,
                                     .scan_speed = "Initial(2400[rpm])<-Default setting by user",
                                     .mesm_idle = "IDLE",
                                     .mesm_single = "Single Scan Mode",
                                     .mesm_multi = "Multi Scan Mode",
                                     .bit_rate = "USB 12[Mbps]<-Default setting by user",
                                     .stat_good = "Sensor works well.",
                                     .code_not_measured = 3,
                                     .ethernet = false,
                                     .scip22 = false,
                                     .two_character = false,
                                     .intensity = true,
                                     .multi_echo = false,
                                     .time_is_scip = false,
                                     .boots_in_scip11 = false,
                                     .sums_to_arrow = true,
                                     .wedges_on_unknown_scan = false,
                                     .serial_speeds = false};

constexpr ScipModelSpec kUtm30LxEwSpec{.model = ScipModel::kUtm30LxEw,
                                       .name = "UTM-30LX-EW",
                                       .vendor = "Hokuyo Automatic Co., Ltd.",
                                       .product = "UTM-30LX-EW",
                                       .firmware = "1.1.0 (2011-09-30)",
                                       .protocol = "SCIP 2.2",
                                       .modl = "UTM-30LX-EW",
                                       .dmin_mm = 23,
                                       .dmax_mm = 60000,
                                       .ares = 1440,
                                       .amin = 0,
                                       .amax = 1080,
                                       .afrt = 540,
                                       .scan_rpm = 2400,
                                       .scan_speed = "2400",
                                       .mesm_idle = "000 Idle",
                                       .mesm_single = "003 Single_scan",
                                       .mesm_multi = "004 Multi_scan",
                                       .bit_rate = "Ethernet 100 [Mbps]",
                                       .stat_good = "Stable 000 no error.",
                                       .code_not_measured = 3,
                                       .ethernet = true,
                                       .scip22 = true,
                                       .two_character = true,
                                       .intensity = true,
                                       .multi_echo = true,
                                       .time_is_scip = false,
                                       .boots_in_scip11 = false,
                                       .sums_to_arrow = false,
                                       .wedges_on_unknown_scan = false,
                                       .serial_speeds = false};

constexpr ScipModelSpec make_ust(ScipModel model, std::string_view name, int dmax_mm) {
  return {.model = model,
          .name = name,
          .vendor = "Hokuyo Automatic Co., Ltd.",
          .product = name,
          .firmware = "4.0.2-A",
          .protocol = "SCIP 2.2",
          .modl = name,
          .dmin_mm = 20,
          .dmax_mm = dmax_mm,
          .ares = 1440,
          .amin = 0,
          .amax = 1080,
          .afrt = 540,
          .scan_rpm = 2400,
          // The UST reports "Measuring ..." even when idle (PROTOCOLS section 11).
          .scan_speed = "2400",
          .mesm_idle = "Measuring by Sensitive Mode",
          .mesm_single = "Measuring by Sensitive Mode",
          .mesm_multi = "Measuring by Sensitive Mode",
          .bit_rate = "Ethernet 100[Mbps]",
          .stat_good = "sensor is working normally",
          .code_not_measured = 3,
          .ethernet = true,
          .scip22 = true,
          .two_character = true,
          .intensity = true,
          .multi_echo = false,
          .time_is_scip = true,
          .boots_in_scip11 = false,
          .sums_to_arrow = false,
          .wedges_on_unknown_scan = false,
          .serial_speeds = false};
}
constexpr ScipModelSpec kUst10LxSpec = make_ust(ScipModel::kUst10Lx, "UST-10LX", 30000);
constexpr ScipModelSpec kUst20LxSpec = make_ust(ScipModel::kUst20Lx, "UST-20LX", 60000);

constexpr ScipModelSpec kUrg04LxSpec{.model = ScipModel::kUrg04Lx,
                                     .name = "URG-04LX",
                                     .vendor = "Hokuyo Automatic Co.,Ltd.",
                                     .product = "SOKUIKI Sensor URG-04LX",
                                     .firmware = "3.1.00(18/Jan./2007)",
                                     .protocol = "SCIP 2.0",
                                     .modl = "URG-04LX(Hokuyo Automatic Co.,Ltd.)",
                                     .dmin_mm = 20,
                                     .dmax_mm = 5600,
                                     .ares = 1024,
                                     .amin = 44,
                                     .amax = 725,
                                     .afrt = 384,
                                     .scan_rpm = 600,
                                     .scan_speed = "Initial(600[rpm])<-Default setting by user",
                                     .mesm_idle = "IDLE",
                                     .mesm_single = "Single Scan Mode",
                                     .mesm_multi = "Multi Scan Mode",
                                     .bit_rate = "19200[bps]<-Default setting by user",
                                     .stat_good = "Sensor works well.",
                                     .code_not_measured = 19,
                                     .ethernet = false,
                                     .scip22 = false,
                                     .two_character = true,
                                     .intensity = false,
                                     .multi_echo = false,
                                     .time_is_scip = false,
                                     .boots_in_scip11 = true,
                                     .sums_to_arrow = false,
                                     .wedges_on_unknown_scan = true,
                                     .serial_speeds = true};

constexpr std::array<const ScipModelSpec*, 5> kSpecs{&kUtm30LxSpec, &kUtm30LxEwSpec, &kUst10LxSpec,
                                                     &kUst20LxSpec, &kUrg04LxSpec};

}  // namespace

const ScipModelSpec& scip_model(ScipModel model) {
  for (const ScipModelSpec* spec : kSpecs) {
    if (spec->model == model) return *spec;
  }
  return kUtm30LxSpec;
}

std::optional<ScipModel> find_scip_model(std::string_view name) {
  for (const ScipModelSpec* spec : kSpecs) {
    if (spec->name == name) return spec->model;
  }
  return std::nullopt;
}

std::string scip_model_names() {
  std::string names;
  for (const ScipModelSpec* spec : kSpecs) names.append(names.empty() ? "" : ", ").append(spec->name);
  return names;
}

}  // namespace topo::sim
