// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/scip_device.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

#include "tests/sim/devices/scip_text.hpp"
#include "tests/unit/sim/devices/device_tools.hpp"

namespace topo::sim {
namespace {

using namespace std::chrono_literals;

scip::Turn turn_at(const ScipModelSpec& model, SimTime step0) {
  scip::Turn turn;
  turn.step0 = step0;
  turn.beams.resize(static_cast<std::size_t>(model.beams()));
  for (std::size_t i = 0; i < turn.beams.size(); ++i) {
    turn.beams[i].echoes[0] = {1000 + static_cast<std::uint32_t>(i), 500};
  }
  return turn;
}

void set_beams(scip::Turn& turn, std::size_t first, const std::vector<std::vector<scip::Echo>>& beams) {
  for (std::size_t i = 0; i < beams.size(); ++i) {
    auto& beam = turn.beams[first + i];
    beam.count = static_cast<std::uint8_t>(beams[i].size());
    std::copy(beams[i].begin(), beams[i].end(), beam.echoes.begin());
  }
}

/// A device and the conversation with it.
struct Talk {
  explicit Talk(ScipOptions options) : device(std::move(options)) {}
  explicit Talk(ScipModel model) : Talk(ScipOptions{.model = model}) {}

  std::string ask(const std::string& text) {
    send(device, text, now);
    return drain(device, now);
  }
  /// One more turn of the mirror; what has left a little after its end.
  std::string turn() { return turn(turn_at(device.model(), now)); }
  std::string turn(const scip::Turn& data) {
    now += device.model().period();
    device.deliver(data, now);
    device.tick(now);
    return drain(device, now + 2ms);
  }

  ScipDevice device;
  SimTime now{0};
};

std::string second_line(const std::string& reply) {
  const auto begin = reply.find('\n') + 1;
  return reply.substr(begin, reply.find('\n', begin) - begin);
}

TEST(ScipText, KnowsTheStatusLinesOfTheFactSheet) {
  for (const std::string line : {"00P", "99b", "01Q", "02R", "03S", "04T", "05U", "10Q", "0Bb", "0Cc", "0Dd",
                                 "0Ee", "0Ff", "0Ll", "98a"}) {
    EXPECT_EQ(scip::checksum(line.substr(0, 2)), line[2]) << line;
  }
}

TEST(ScipText, EncodesTheExamplesOfTheFactSheet) {
  const auto encode = [](std::uint32_t value, int digits) {
    std::string out;
    scip::append_value(out, value, digits);
    return out;
  };
  EXPECT_EQ(encode(1234, 2), "CB");
  EXPECT_EQ(encode(5432, 3), "1Dh");
  EXPECT_EQ(encode(16000000, 4), "m2@0");
  EXPECT_EQ(encode(65533, 3), "?om");
  EXPECT_EQ(encode(60000, 3), ">YP");
  EXPECT_EQ(encode(5000, 2), "oo") << "two characters saturate at 4095";
}

TEST(ScipText, CutsBlocksAfter64CharactersWithoutAnEmptyPiece) {
  std::string out;
  scip::append_block(out, std::string(128, '0'));
  EXPECT_EQ(out.size(), 2U * 66U);
  out.clear();
  scip::append_block(out, std::string(65, '0'));
  EXPECT_EQ(out.size(), 66U + 3U);
}

// ---- the vectors of PROTOCOLS section 16 ----

ScipOptions at_1234567(ScipModel model) { return {.model = model, .clock_offset_ms = 1234567.0}; }

TEST(ScipVectors, MdDistances) {
  Talk talk(at_1234567(ScipModel::kUtm30LxEw));
  EXPECT_EQ(talk.ask("MD0540054401001\n"), "MD0540054401001\n00P\n\n");
  auto turn = turn_at(talk.device.model(), 0ms);
  set_beams(turn, 540, {{{1000, 0}}, {{1234, 0}}, {{5432, 0}}, {{65533, 0}}, {{1, 0}}});
  EXPECT_EQ(talk.turn(turn), "MD0540054401000\n99b\n4]J7B\n0?X0CB1Dh?om0015\n\n");
}

TEST(ScipVectors, MeDistancesAndIntensities) {
  Talk talk(at_1234567(ScipModel::kUst20Lx));
  talk.ask("ME0540054201001\n");
  auto turn = turn_at(talk.device.model(), 0ms);
  set_beams(turn, 540, {{{1000, 2000}}, {{1234, 1500}}, {{5432, 900}}});
  EXPECT_EQ(talk.turn(turn), "ME0540054201000\n99b\n4]J7B\n0?X0O@0CB0GL1Dh0>4m\n\n");
}

TEST(ScipVectors, NdEchoes) {
  Talk talk(at_1234567(ScipModel::kUtm30LxEw));
  talk.ask("ND0540054201000\n");
  auto turn = turn_at(talk.device.model(), 0ms);
  set_beams(turn, 540, {{{1000, 0}, {1500, 0}}, {{2000, 0}}, {{2500, 0}, {2600, 0}, {2700, 0}}});
  EXPECT_EQ(talk.turn(turn), "ND0540054201000\n99b\n4]J7B\n0?X&0GL0O@0W4&0XX&0Z<L\n\n");
}

TEST(ScipVectors, TimeJustBeforeTheWrapAndAfter) {
  Talk talk({.model = ScipModel::kUtm30LxEw, .clock_offset_ms = 16777215.0});
  EXPECT_EQ(talk.ask("TM0\n"), "TM0\n00P\n\n");
  EXPECT_EQ(talk.ask("TM1\n"), "TM1\n00P\nooool\n\n");
  talk.now += 1ms;
  EXPECT_EQ(talk.ask("TM1\n"), "TM1\n00P\n00000\n\n");
}

// ---- the replies of PROTOCOLS section 11 ----

TEST(ScipDevice, IdentifiesAsTheUtm30LxEw) {
  Talk talk(ScipModel::kUtm30LxEw);
  EXPECT_EQ(talk.ask("VV\n"),
            "VV\n00P\nVEND:Hokuyo Automatic Co., Ltd.;;\nPROD:UTM-30LX-EW;R\nFIRM:1.1.0 (2011-09-30);a\n"
            "PROT:SCIP 2.2;P\nSERI:H0123456;J\n\n");
  EXPECT_EQ(talk.ask("PP\n"),
            "PP\n00P\nMODL:UTM-30LX-EW;I\nDMIN:23;7\nDMAX:60000;J\nARES:1440;^\nAMIN:0;?\nAMAX:1080;Z\n"
            "AFRT:540;0\nSCAN:2400;U\n\n");
  talk.now = 1234ms;
  EXPECT_EQ(
      talk.ask("II\n"),
      "II\n00P\nMODL:UTM-30LX-EW;I\nLASR:OFF;7\nSCSP:2400;i\nMESM:000 Idle;J\nSBPS:Ethernet 100 [Mbps];<\n"
      "TIME:0004D2;S\nSTAT:Stable 000 no error.;f\n\n");
}

TEST(ScipDevice, IdentifiesAsTheUrgOnlyAfterScip2) {
  Talk talk({.model = ScipModel::kUrg04Lx, .serial = "H0614967"});
  EXPECT_EQ(talk.ask("VV\n"), "VV\nE\n\n");
  EXPECT_EQ(talk.ask("SCIP2.0\n"), "SCIP2.0\n0\n\n");
  EXPECT_EQ(talk.ask("SCIP2.0\n"), "SCIP2.0\n0Ee\n\n");
  EXPECT_EQ(talk.ask("VV\n"),
            "VV\n00P\nVEND:Hokuyo Automatic Co.,Ltd.;[\nPROD:SOKUIKI Sensor URG-04LX;[\n"
            "FIRM:3.1.00(18/Jan./2007);`\nPROT:SCIP 2.0;N\nSERI:H0614967;V\n\n");
  EXPECT_NE(talk.ask("II\n").find("SBPS:19200[bps]<-Default setting by user;A\n"), std::string::npos);
  talk.device.power_cycle(talk.now);
  EXPECT_EQ(talk.ask("VV\n"), "VV\nE\n\n");
}

TEST(ScipDevice, UtmUsbSumsOnlyToTheArrow) {
  Talk talk(ScipModel::kUtm30Lx);
  const std::string reply = talk.ask("II\n");
  const std::string summed = "SCSP:Initial(2400[rpm])";
  EXPECT_NE(reply.find(summed + "<-Default setting by user;" + scip::checksum(summed) + "\n"),
            std::string::npos);
}

// ---- requests ----

TEST(ScipDevice, EchoesStringsAndRefusesBadOnes) {
  Talk talk(ScipModel::kUst10Lx);
  EXPECT_EQ(talk.ask("BM;ab 7._+@\n"), "BM;ab 7._+@\n00P\n\n");
  EXPECT_EQ(talk.ask("BM;12345678901234567\n").substr(21, 3), "0Gg");
  EXPECT_EQ(talk.ask("BM;a!\n"), "BM;a!\n0Hh\n\n");
}

TEST(ScipDevice, AcceptsAllThreeLineEnds) {
  Talk talk(ScipModel::kUst10Lx);
  EXPECT_EQ(talk.ask("BM\r"), "BM\n00P\n\n");
  EXPECT_EQ(talk.ask("BM\r\n"), "BM\n02R\n\n");
  EXPECT_EQ(talk.ask("\n\r\n"), "");
}

TEST(ScipDevice, NamesEveryFaultOfAScanRequest) {
  Talk talk(ScipModel::kUtm30LxEw);
  const std::vector<std::pair<std::string, std::string>> cases{{"MDx000108001000", "01Q"},
                                                               {"MD0000x08001000", "02R"},
                                                               {"MD00001080x1000", "03S"},
                                                               {"MD0000108101000", "04T"},
                                                               {"MD0100005001000", "05U"},
                                                               {"MD0000108001x00", "06V"},
                                                               {"MD00001080010x0", "07W"},
                                                               {"MD000010800100", "0Cc"},
                                                               {"MD00001080010000", "0Dd"},
                                                               {"GD0000108001", "10Q"},
                                                               {"XX", "0Ee"},
                                                               {"TM9", "01Q"}};
  for (const auto& [line, status] : cases) EXPECT_EQ(second_line(talk.ask(line + "\n")), status) << line;
}

TEST(ScipDevice, OffersOnlyWhatTheModelHas) {
  Talk usb(ScipModel::kUtm30Lx);
  EXPECT_EQ(second_line(usb.ask("MS0000108001000\n")), "0Ee");
  EXPECT_EQ(second_line(usb.ask("ND0000108001000\n")), "0Ee");
  EXPECT_EQ(second_line(usb.ask("RB\n")), "0Ee");
  EXPECT_EQ(second_line(usb.ask("SS115200\n")), "04T");
  EXPECT_EQ(second_line(usb.ask("HS1\n")), "03S");
  EXPECT_EQ(second_line(usb.ask("CR00\n")), "04T");
  Talk ust(ScipModel::kUst10Lx);
  EXPECT_EQ(second_line(ust.ask("NE0000108001000\n")), "0Ee");
}

TEST(ScipDevice, AnUnsupportedScanWedgesTheUrgUntilPowerCycle) {
  Talk talk(ScipModel::kUrg04Lx);
  talk.ask("SCIP2.0\n");
  EXPECT_EQ(talk.ask("ME0044072501000\n"), "");
  EXPECT_EQ(talk.ask("QT\nRS\n"), "");
  talk.device.power_cycle(talk.now);
  EXPECT_EQ(talk.ask("SCIP2.0\n"), "SCIP2.0\n0\n\n");
}

TEST(ScipDevice, UrgChangesItsBitRate) {
  Talk talk(ScipModel::kUrg04Lx);
  talk.ask("SCIP2.0\n");
  EXPECT_EQ(second_line(talk.ask("SS019200\n")), "03S");
  EXPECT_EQ(second_line(talk.ask("SS115200\n")), "00P");
  EXPECT_EQ(second_line(talk.ask("SS123456\n")), "02R");
  EXPECT_EQ(second_line(talk.ask("SSabcdef\n")), "01Q");
}

// ---- modes ----

TEST(ScipDevice, TimeModeRefusesMeasuring) {
  Talk talk(ScipModel::kUtm30Lx);
  EXPECT_EQ(second_line(talk.ask("TM1\n")), "04T");
  EXPECT_EQ(second_line(talk.ask("TM0\n")), "00P");
  EXPECT_EQ(second_line(talk.ask("TM0\n")), "02R");
  EXPECT_EQ(second_line(talk.ask("BM\n")), "10Q");
  EXPECT_EQ(second_line(talk.ask("MD0000108001000\n")), "10Q");
  EXPECT_EQ(second_line(talk.ask("QT\n")), "0Ee") << "SCIP 2.0 firmware";
  EXPECT_EQ(second_line(talk.ask("TM2\n")), "00P");
  EXPECT_EQ(second_line(talk.ask("TM2\n")), "03S");
  talk.ask("MD0000108001000\n");
  EXPECT_EQ(second_line(talk.ask("TM0\n")), "10Q") << "refused while scanning";
}

TEST(ScipDevice, CountsRemainingScansDownAndStops) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0540054001003;s\n");
  EXPECT_EQ(talk.turn().substr(0, 17), "MD0540054001002;s");
  EXPECT_EQ(talk.turn().substr(0, 17), "MD0540054001001;s");
  EXPECT_EQ(talk.turn().substr(0, 17), "MD0540054001000;s");
  EXPECT_EQ(talk.turn(), "");
  EXPECT_FALSE(talk.device.laser_on());
}

TEST(ScipDevice, IntervalSkipsScans) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0540054001200\n");
  std::string pattern;
  for (int i = 0; i < 7; ++i) pattern += talk.turn().empty() ? '.' : 'x';
  EXPECT_EQ(pattern, "x..x..x");
}

TEST(ScipDevice, ClusterTakesTheSmallestValid) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0540054503001\n");
  auto turn = turn_at(talk.device.model(), 0ms);
  set_beams(turn, 540, {{{1, 0}}, {{1234, 0}}, {{65533, 0}}, {{65533, 0}}, {{1, 0}}, {{3, 0}}});
  std::string expected = "0CB?om";
  EXPECT_NE(talk.turn(turn).find("\n" + expected + scip::checksum(expected) + "\n\n"), std::string::npos);
}

TEST(ScipDevice, FullScansHaveTheSizesOfTheFactSheet) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0000108001000\n");
  EXPECT_EQ(talk.turn().size(), 3372U);
  talk.ask("ME0000108001000\n");
  EXPECT_EQ(talk.turn().size(), 6717U);
  Talk urg(ScipModel::kUrg04Lx);
  urg.ask("SCIP2.0\nMS0044072501000\n");
  EXPECT_EQ(urg.turn().size(), 1435U);
}

TEST(ScipDevice, DataLeaveOnlyAfterTheScanEnded) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0000108001000\n");
  const scip::Turn turn = turn_at(talk.device.model(), 100ms);
  talk.device.deliver(turn, 100ms);  // even a simulation that runs ahead must not leak the future
  EXPECT_EQ(drain(talk.device, 119ms), "");
  EXPECT_EQ(drain(talk.device, 120ms).size(), 3372U);
}

TEST(ScipDevice, QuitIsAnsweredBehindScansUnderWay) {
  Talk talk({.model = ScipModel::kUtm30LxEw, .scans_behind_quit = 2});
  talk.ask("MD0540054001000\n");
  talk.turn();
  EXPECT_EQ(talk.ask("QT\nVV\n"), "");
  EXPECT_EQ(talk.turn().substr(0, 2), "MD");
  const std::string rest = talk.turn();
  EXPECT_EQ(rest.substr(0, 2), "MD");
  EXPECT_LT(rest.find("QT\n00P\n\n"), rest.find("VV\n00P\n"));
  EXPECT_FALSE(talk.device.laser_on());
}

TEST(ScipDevice, QuitIsAnsweredEvenWhenNoScanComesAnyMore) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0540054001000\nQT\n");
  talk.now += 200ms;
  talk.device.tick(talk.now);
  EXPECT_EQ(drain(talk.device, talk.now), "QT\n00P\n\n");
}

TEST(ScipDevice, SingleScanWaitsForTheFirstTurn) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("BM\n");
  EXPECT_EQ(talk.ask("GD0540054101;g\n"), "");
  EXPECT_EQ(talk.turn().substr(0, 19), "GD0540054101;g\n00P\n");
  EXPECT_EQ(talk.ask("GD0540054101\n").substr(0, 17), "GD0540054101\n00P\n");
}

TEST(ScipDevice, ResetZeroesTheTimerAndEndsTheStream) {
  Talk talk({.model = ScipModel::kUst10Lx, .clock_offset_ms = 500.0});
  talk.ask("MD0540054001000\n");
  talk.now = 300ms;
  EXPECT_EQ(talk.device.clock_ms(talk.now), 800U);
  EXPECT_EQ(talk.ask("RS\n"), "RS\n00P\n\n");
  EXPECT_EQ(talk.device.clock_ms(talk.now), 0U);
  EXPECT_FALSE(talk.device.streaming());
}

TEST(ScipDevice, RebootNeedsTwoRequestsWithinASecond) {
  Talk talk(ScipModel::kUtm30LxEw);
  EXPECT_EQ(second_line(talk.ask("RB\n")), "01Q");
  talk.now += 2s;
  EXPECT_EQ(second_line(talk.ask("RB\n")), "01Q");
  EXPECT_EQ(second_line(talk.ask("RB\n")), "00P");
  EXPECT_FALSE(talk.device.take_absence(talk.now).has_value());
  EXPECT_TRUE(talk.device.take_absence(talk.now + 1s).has_value());
}

TEST(ScipDevice, AFaultStopsTheStreamAndShowsInTheStatus) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0540054001000\n");
  talk.device.set_health(ScipHealth::kFault, talk.now);
  EXPECT_EQ(drain(talk.device, talk.now), "MD0540054001000\n70W\n\n");
  EXPECT_EQ(second_line(talk.ask("QT\n")), "0Ll");
  EXPECT_NE(talk.ask("II\n").find("STAT:Trouble!! Error No. =[00->33];"), std::string::npos);
  EXPECT_EQ(talk.turn(), "");
  talk.device.set_health(ScipHealth::kSilent, talk.now);
  EXPECT_EQ(talk.ask("VV\n"), "");
}

TEST(ScipDevice, AClientThatDoesNotReadLosesWholeScans) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("MD0000108001000\n");
  for (int i = 0; i < 200; ++i) {
    talk.now += 25ms;
    talk.device.deliver(turn_at(talk.device.model(), talk.now - 25ms), talk.now);
  }
  EXPECT_GT(talk.device.output().dropped(), 0U);
  EXPECT_EQ(drain(talk.device, talk.now + 1s).size() % 3372U, 0U);
}

TEST(ScipDevice, ClockDriftsAndJumps) {
  Talk talk({.model = ScipModel::kUtm30LxEw, .clock_drift_ppm = 100.0});
  EXPECT_EQ(talk.device.clock_ms(1000s), 1000100U);
  talk.device.jump_clock(-50.0);
  EXPECT_EQ(talk.device.clock_ms(1000s), 1000050U);
}

TEST(ScipDevice, ALostTcpClientIdlesTheSensor) {
  Talk talk(ScipModel::kUtm30LxEw);
  talk.ask("TM0\nTM2\nMD0540054001000\nV");
  talk.device.client_gone(talk.now);
  EXPECT_FALSE(talk.device.laser_on());
  EXPECT_EQ(talk.ask("TM0\n"), "TM0\n00P\n\n") << "half a request of the old client is gone";
}

TEST(ScipDevice, AnyCutOfTheInputGivesTheSameOutput) {
  const std::string script =
      "VV\nPP\r\nII;x\rTM0\nTM1\nTM2\nnonsense\nMD0540054401000\nVV\nQT\nBM\nGD0540054101\nRS\n" +
      std::string(300, 'z') + "\nBM\n";
  const auto run = [&script](const std::vector<std::size_t>& cuts) {
    Talk talk(ScipModel::kUtm30LxEw);
    send_cut(talk.device, script, cuts, talk.now);
    std::string out = drain(talk.device, talk.now);
    for (int i = 0; i < 4; ++i) out += talk.turn();
    return out;
  };
  const std::string whole = run({});
  ASSERT_NE(whole.find("QT\n00P"), std::string::npos);
  EXPECT_TRUE(rc::check([&](const std::vector<std::size_t>& cuts) { RC_ASSERT(run(cuts) == whole); }));
}

TEST(ScipDevice, SurvivesAnyBytes) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint8_t>& bytes, bool structured) {
    Talk talk(ScipModel::kUtm30LxEw);
    const std::vector<std::string> words{"MD", "GD", "0000", "1080", "TM", ";", "\n", "QT", "0101000", "\r"};
    for (const std::uint8_t byte : bytes) {
      const std::string piece =
          structured ? words[byte % words.size()] : std::string(1, static_cast<char>(byte));
      send(talk.device, piece, talk.now);
      if (byte % 16 == 0) talk.turn();
    }
    talk.now += 1s;
    talk.device.tick(talk.now);
    drain(talk.device, talk.now);
    talk.ask("\n");
    talk.device.power_cycle(talk.now);
    drain(talk.device, talk.now);
    RC_ASSERT(talk.ask("BM\n") == "BM\n00P\n\n");
  }));
}

TEST(ScipDevice, TakesAnAddressThatHoldsFromThePowerCycleOn) {
  const std::string network = "192168000011255255255000192168000001";
  Talk talk(ScipModel::kUst10Lx);
  EXPECT_EQ(talk.ask("$IP" + network + "\n"), "$IP" + network + "\n00P\n\n");
  EXPECT_EQ(talk.device.network(), "");
  talk.device.power_cycle(talk.now);
  EXPECT_EQ(talk.device.network(), network);
  EXPECT_EQ(second_line(talk.ask("$IP192\n")).substr(0, 2), "0C");
  EXPECT_EQ(second_line(talk.ask("$IP" + network + "0\n")).substr(0, 2), "0D");
  EXPECT_EQ(second_line(talk.ask("$IP999" + network.substr(3) + "\n")).substr(0, 2), "01");
  talk.device.power_cycle(talk.now);
  EXPECT_EQ(talk.device.network(), network) << "what was refused has no effect";
}

TEST(ScipDevice, AModelOnUsbHasNoAddress) {
  Talk talk(ScipModel::kUrg04Lx);
  talk.ask("SCIP2.0\n");
  EXPECT_EQ(second_line(talk.ask("$IP192168000011255255255000192168000001\n")).substr(0, 2), "0E");
}

}  // namespace
}  // namespace topo::sim
