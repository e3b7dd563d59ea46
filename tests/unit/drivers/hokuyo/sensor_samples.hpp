// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drivers/hokuyo/identity.hpp"

namespace topo::hokuyo::testing_scip {

/// Replies as real sensors give them (PROTOCOLS section 11), check characters included.
struct Sample {
  Family family;
  const char* serial;
  const char* vv;
  const char* pp;
  const char* ii;
  int amin, amax, ares, rpm, dmin, dmax;
};

inline constexpr Sample kSamples[] = {
    {Family::kUtmEw, "H0123456",
     "VEND:Hokuyo Automatic Co., Ltd.;;\nPROD:UTM-30LX-EW;R\nFIRM:1.1.0 (2011-09-30);a\nPROT:SCIP "
     "2.2;P\nSERI:H0123456;J\n",
     "MODL:UTM-30LX-EW;I\nDMIN:23;7\nDMAX:60000;J\nARES:1440;^\nAMIN:0;?\nAMAX:1080;Z\nAFRT:540;0\nSCAN:2400;"
     "U\n",
     "MODL:UTM-30LX-EW;I\nLASR:OFF;7\nSCSP:2400;i\nMESM:000 Idle;J\nSBPS:Ethernet 100 "
     "[Mbps];<\nTIME:0004D2;S\n"
     "STAT:Stable 000 no error.;f\n",
     0, 1080, 1440, 2400, 23, 60000},
    {Family::kUtm, "H0902680",
     "VEND:Hokuyo Automatic Co.,Ltd.;[\nPROD:SOKUIKI Sensor TOP-URG "
     "UTM-30LX;P\nFIRM:1.16.01(16/Nov./2009);o\n"
     "PROT:SCIP 2.0;N\nSERI:H0902680;N\n",
     "MODL:UTM-30LX(Hokuyo Automatic "
     "Co.,Ltd.);U\nDMIN:23;7\nDMAX:60000;J\nARES:1440;^\nAMIN:0;?\nAMAX:1080;Z\n"
     "AFRT:540;0\nSCAN:2400;U\n",
     "LASR:OFF;7\nSCSP:2400;i\nSTAT:Sensor works well.;8\n", 0, 1080, 1440, 2400, 23, 60000},
    {Family::kUst, "H1614934",
     "VEND:Hokuyo Automatic Co., Ltd.;;\nPROD:UST-10LX;M\nFIRM:4.0.2-A;8\nPROT:SCIP 2.2;P\nSERI:H1614934;Q\n",
     "MODL:UST-10LX;D\nDMIN:20;4\nDMAX:30000;G\nARES:1440;^\nAMIN:0;?\nAMAX:1080;Z\nAFRT:540;0\nSCAN:2400;"
     "U\n",
     "LASR:OFF;7\nSCSP:2400;i\nMESM:Measuring by Sensitive Mode;A\nSBPS:Ethernet 100[Mbps];\\\n"
     "STAT:sensor is working normally;k\n",
     0, 1080, 1440, 2400, 20, 30000},
    {Family::kUrg, "H0614967",
     "VEND:Hokuyo Automatic Co.,Ltd.;[\nPROD:SOKUIKI Sensor "
     "URG-04LX;[\nFIRM:3.1.00(18/Jan./2007);`\nPROT:SCIP 2.0;N\n"
     "SERI:H0614967;V\n",
     "MODL:URG-04LX(Hokuyo Automatic "
     "Co.,Ltd.);N\nDMIN:20;4\nDMAX:5600;_\nARES:1024;\\\nAMIN:44;7\nAMAX:725;o\n"
     "AFRT:384;6\nSCAN:600;e\n",
     "LASR:OFF;7\nSCSP:Initial(600[rpm])<-Default setting by user;A\nMESM:IDLE;:\n"
     "SBPS:19200[bps]<-Default setting by user;A\nTIME:081615;N\nSTAT:Sensor works well.;8\n",
     44, 725, 1024, 600, 20, 5600},
};

}  // namespace topo::hokuyo::testing_scip
