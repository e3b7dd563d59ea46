// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/arcos_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/drivers/pioneer/hex.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using types::Stamp;

Bytes wire(const CommandPacket& packet) { return to_bytes(packet.bytes()); }

/// A packet with any payload, framed here and not by the codec.
Bytes frame(const Bytes& payload) {
  unsigned sum = 0;
  std::size_t i = 0;
  for (; i + 1 < payload.size(); i += 2)
    sum = (sum + (std::to_integer<unsigned>(payload[i]) * 256 + std::to_integer<unsigned>(payload[i + 1]))) %
          65536;
  if (i < payload.size()) sum ^= std::to_integer<unsigned>(payload[i]);
  const Bytes head{std::byte{0xFA}, std::byte{0xFB}, static_cast<std::byte>(payload.size() + 2)};
  return head + payload + Bytes{static_cast<std::byte>(sum / 256), static_cast<std::byte>(sum % 256)};
}

std::vector<Bytes> parse(PacketParser& parser, std::span<const std::byte> input, Stamp stamp = Stamp{}) {
  std::vector<Bytes> out;
  while (const auto packet = parser.next(input, stamp)) out.push_back(to_bytes(packet->payload));
  return out;
}

std::vector<Bytes> parse_once(const Bytes& input) {
  PacketParser parser;
  return parse(parser, input);
}

Bytes payload_of(const Bytes& packet) { return {packet.begin() + 3, packet.end() - 2}; }

std::vector<Bytes> payloads_of(const std::vector<Bytes>& packets) {
  std::vector<Bytes> out;
  for (const Bytes& p : packets) out.push_back(payload_of(p));
  return out;
}

auto any_payload() {
  return rc::gen::mapcat(rc::gen::inRange<std::size_t>(1, kMaxCount - 1), [](std::size_t size) {
    return rc::gen::container<Bytes>(size, rc::gen::map(rc::gen::inRange(0, 256), [](int v) {
                                       // Heads are made frequent: they are what a parser trips over.
                                       return static_cast<std::byte>(v < 16 ? 0xFA : v < 32 ? 0xFB : v);
                                     }));
  });
}

TEST(ArcosCodec, EncodesEveryVector) {
  EXPECT_EQ(wire(encode(Command::kPulse)), from_hex("fa fb 03 00 00 00"));
  EXPECT_EQ(wire(encode(Command::kOpen, 1)), from_hex("fa fb 06 01 3b 01 00 02 3b"));
  EXPECT_EQ(wire(encode(Command::kClose, 1)), from_hex("fa fb 06 02 3b 01 00 03 3b"));
  EXPECT_EQ(wire(encode(Command::kEnable, 1)), from_hex("fa fb 06 04 3b 01 00 05 3b"));
  EXPECT_EQ(wire(encode(Command::kVel, 250)), from_hex("fa fb 06 0b 3b fa 00 05 3b"));
  EXPECT_EQ(wire(encode(Command::kVel, -250)), from_hex("fa fb 06 0b 1b fa 00 05 1b"));
  EXPECT_EQ(wire(encode(Command::kRvel, -20)), from_hex("fa fb 06 15 1b 14 00 29 1b"));
  EXPECT_EQ(wire(encode(Command::kSetV, 500)), from_hex("fa fb 06 06 3b f4 01 fa 3c"));
  EXPECT_EQ(wire(encode(Command::kSetA, -300)), from_hex("fa fb 06 05 1b 2c 01 31 1c"));
  EXPECT_EQ(wire(encode(Command::kStop)), from_hex("fa fb 03 1d 00 1d"));
  EXPECT_EQ(wire(encode(Command::kEStop)), from_hex("fa fb 03 37 00 37"));
  EXPECT_EQ(wire(encode(Command::kSetO)), from_hex("fa fb 03 07 00 07"));
  EXPECT_EQ(wire(encode(Command::kSonar, 0)), from_hex("fa fb 06 1c 3b 00 00 1c 3b"));
  EXPECT_EQ(wire(encode(Command::kConfig, 1)), from_hex("fa fb 06 12 3b 01 00 13 3b"));
  EXPECT_EQ(wire(encode(Command::kEncoder, 2)), from_hex("fa fb 06 13 3b 02 00 15 3b"));
  EXPECT_EQ(wire(encode(Command::kHostBaud, 4)), from_hex("fa fb 06 32 3b 04 00 36 3b"));
}

TEST(ArcosCodec, EncodesTheSyncSequence) {
  EXPECT_EQ(wire(encode(static_cast<Command>(0))), from_hex("fa fb 03 00 00 00"));
  EXPECT_EQ(wire(encode(static_cast<Command>(1))), from_hex("fa fb 03 01 00 01"));
  EXPECT_EQ(wire(encode(static_cast<Command>(2))), from_hex("fa fb 03 02 00 02"));
}

TEST(ArcosCodec, ClampsArguments) {
  EXPECT_EQ(wire(encode(Command::kVel, 100000)), wire(encode(Command::kVel, 32767)));
  EXPECT_EQ(wire(encode(Command::kVel, -100000)), wire(encode(Command::kVel, -32767)));
}

TEST(ArcosParser, AcceptsTheRobotsVectors) {
  for (const Bytes& packet : {kSync2Reply, kStatusVector, kEncoderVector}) {
    EXPECT_EQ(parse_once(packet), payloads_of({packet}));
  }
}

TEST(ArcosParser, EveryEncodedCommandParses) {
  EXPECT_TRUE(rc::check([](int command, int argument) {
    const auto packet = wire(encode(static_cast<Command>(command & 0xFF), argument));
    RC_ASSERT(parse_once(packet) == payloads_of({packet}));
  }));
}

TEST(ArcosParser, AnySplitGivesTheSamePackets) {
  EXPECT_TRUE(rc::check([] {
    const auto payloads = *rc::gen::container<std::vector<Bytes>>(3, any_payload());
    Bytes stream;
    for (const Bytes& p : payloads) stream = stream + frame(p);
    PacketParser parser;
    std::vector<Bytes> found;
    std::span<const std::byte> rest(stream);
    while (!rest.empty()) {
      const auto size = *rc::gen::inRange<std::size_t>(1, rest.size() + 1);
      for (auto& p : parse(parser, rest.first(size))) found.push_back(std::move(p));
      rest = rest.subspan(size);
    }
    RC_ASSERT(found == payloads);
    RC_ASSERT(parser.counters().skipped_bytes == 0U);
  }));
}

TEST(ArcosParser, NothingWithABadChecksumIsAccepted) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint8_t>& noise) {
    // Whatever the bytes: each packet found frames to bytes that stand in the stream.
    const Bytes good = *any_payload();
    Bytes stream = to_bytes(std::as_bytes(std::span(noise))) + frame(good);
    const auto place = *rc::gen::inRange<std::size_t>(0, stream.size());
    stream[place] ^= static_cast<std::byte>(*rc::gen::inRange(1, 256));
    for (const Bytes& payload : parse_once(stream)) {
      const Bytes framed = frame(payload);
      RC_ASSERT(std::search(stream.begin(), stream.end(), framed.begin(), framed.end()) != stream.end());
    }
  }));
}

TEST(ArcosParser, RecoversAfterCorruptionWithoutLosingTheNextPackets) {
  EXPECT_TRUE(rc::check([] {
    auto broken = frame(*any_payload());
    const auto place = *rc::gen::inRange<std::size_t>(0, broken.size());
    broken[place] ^= static_cast<std::byte>(*rc::gen::inRange(1, 256));
    // Whatever a false head claims, it is at most one packet long: the gap ends it, as a robot's cycle does.
    PacketParser parser;
    parse(parser, broken, Stamp{});
    const auto after = parse(parser, kStatusVector, Stamp{milliseconds(101)});
    RC_ASSERT(!after.empty());
    RC_ASSERT(after.back() == payload_of(kStatusVector));
  }));
}

TEST(ArcosParser, FindsThePacketInsideABrokenOne) {
  // A head that claims 200 bytes, then whole packets, then bytes enough to complete the claim.
  Bytes stream = from_hex("fa fb c8") + kStatusVector + kEncoderVector + Bytes(200, std::byte{0});
  EXPECT_EQ(parse_once(stream), payloads_of({kStatusVector, kEncoderVector}));
}

TEST(ArcosParser, HandlesADoubledHead) {
  EXPECT_EQ(parse_once(from_hex("fa") + kStatusVector), payloads_of({kStatusVector}));
  EXPECT_EQ(parse_once(from_hex("fa fa fa") + kEncoderVector), payloads_of({kEncoderVector}));
  EXPECT_EQ(parse_once(from_hex("fa fb fa fb") + Bytes(kEncoderVector.begin() + 2, kEncoderVector.end())),
            payloads_of({kEncoderVector}));
}

TEST(ArcosParser, RejectsCountsOutOfRange) {
  for (const char* head : {"fa fb 00", "fa fb 02", "fa fb cd", "fa fb ff"}) {
    PacketParser parser;
    EXPECT_EQ(parse(parser, from_hex(head) + kEncoderVector), payloads_of({kEncoderVector})) << head;
    EXPECT_EQ(parser.counters().bad_counts, 1U) << head;
  }
  const Bytes longest = frame(Bytes(kMaxCount - 2, std::byte{7}));
  EXPECT_EQ(parse_once(longest), payloads_of({longest}));
}

TEST(ArcosParser, AResetWithinAPacketIsFoundWithoutMoreBytes) {
  // The beginning of a SIP, then the controller's 0xFF.
  const Bytes bytes = from_hex("fa fb 28 33 fe 7f 05 00 fa fb 03 ff 00 ff");
  PacketParser parser;
  std::span<const std::byte> input(bytes);
  EXPECT_FALSE(parser.next(input, Stamp{milliseconds(1000)}));
  EXPECT_TRUE(input.empty());
  EXPECT_FALSE(parser.next(input, Stamp{milliseconds(1100)}));  // may still go on
  const auto packet = parser.next(input, Stamp{milliseconds(1101)});
  ASSERT_TRUE(packet);
  EXPECT_TRUE(packet->is(PacketType::kReset));
  EXPECT_EQ(packet->last_byte, Stamp{milliseconds(1000)});
  EXPECT_FALSE(parser.next(input, Stamp{milliseconds(2000)}));
  EXPECT_EQ(parser.counters().abandoned, 1U);
}

TEST(ArcosParser, AbandonsAPacketAfterAGap) {
  PacketParser parser;
  const auto head = std::span(kStatusVector).first(10);
  EXPECT_TRUE(parse(parser, head, Stamp{milliseconds(0)}).empty());
  EXPECT_EQ(parse(parser, kEncoderVector, Stamp{milliseconds(101)}), payloads_of({kEncoderVector}));
  EXPECT_EQ(parser.counters().abandoned, 1U);

  EXPECT_TRUE(parse(parser, head, Stamp{milliseconds(200)}).empty());
  EXPECT_EQ(parse(parser, std::span(kStatusVector).subspan(10), Stamp{milliseconds(300)}),
            payloads_of({kStatusVector}));
}

TEST(ArcosParser, StampsFirstAndLastByte) {
  PacketParser parser;
  std::span<const std::byte> head = std::span(kStatusVector).first(1);
  std::span<const std::byte> tail = std::span(kStatusVector).subspan(1);
  EXPECT_FALSE(parser.next(head, Stamp{milliseconds(5)}));
  const auto packet = parser.next(tail, Stamp{milliseconds(9)});
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->first_byte, Stamp{milliseconds(5)});
  EXPECT_EQ(packet->last_byte, Stamp{milliseconds(9)});
  EXPECT_EQ(packet->wire_bytes(), kStatusVector.size());
  EXPECT_TRUE(packet->is_status());
}

}  // namespace
}  // namespace topo::pioneer
