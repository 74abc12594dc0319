// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section V: data packets of an HDL-32E, in captures.
#include <algorithm>
#include <random>
#include <utility>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/capture_samples.hpp"

namespace verge::faults {
namespace {

using sensor::velodyne::kBlocksPerPacket;
using sensor::velodyne::kSlotsPerBlock;
using sensor::velodyne::kTurn;
using sensor::velodyne::Model;
using sensor::velodyne::RawBlock;
using sensor::velodyne::RawPacket;
using sensor::velodyne::testing::StreamPlan;
using testing::capture_of;
using testing::SensorPacket;

using Change = std::function<void(RawPacket&)>;
using Capture = std::function<std::string()>;

std::string clean() { return capture_of(packets()); }

/// Packets [first, end) of the clean capture changed.
Capture changed(std::size_t first, std::size_t end, const Change& to) {
  return [=] {
    Packets sent = packets();
    for (std::size_t i = first; i < end; ++i) change(sent[i], to);
    return capture_of(sent);
  };
}
/// Packet 30 changed, and all of them.
Capture one_changed(const Change& to) { return changed(30, 31, to); }
Capture all_changed(const Change& to) { return changed(0, kPackets, to); }

BadInput input(std::string code, std::string title, Capture capture, Exit exit = kGood) {
  return {.code = std::move(code),
          .title = std::move(title),
          .make = file("V.pcap", std::move(capture)),
          .exit = exit};
}

/// One scan of so many points; `counter` counted once, and a warning about it.
BadInput counted(std::string code, std::string title, Capture capture, std::size_t points,
                 std::string counter, std::string warns) {
  BadInput bad = input(std::move(code), std::move(title), std::move(capture));
  bad.used = points;
  bad.scans = 1;
  bad.counted = {{std::move(counter), 1}};
  bad.warns = std::move(warns);
  return bad;
}

std::string two_digits(std::size_t number) { return (number < 10 ? "0" : "") + std::to_string(number); }

void set_all(RawPacket& packet, std::uint16_t distance) {
  for (RawBlock& block : packet.blocks) block.distance.fill(distance);
}

void add_sizes(std::vector<BadInput>& all) {
  char variant = 'a';
  for (const std::size_t size : {1205U, 1207U, 0U, 65'507U}) {
    all.push_back(counted(
        std::string("V01") + variant++, "PayloadOf" + std::to_string(size),
        [bytes = size] {
          return clean().insert(record_at(30), record_of({std::string(bytes, '\0'), packets()[30].time_ns}));
        },
        kAllPoints, "packets of another size", "1 packets are neither 1206 nor 512 bytes long"));
  }
  all.push_back(input(
      "V01e", "AllPayloadsOf1205",
      [] {
        Packets sent = packets();
        for (SensorPacket& packet : sent) packet.payload.pop_back();
        return capture_of(sent);
      },
      kUnusable));
  all.back().says = "no data packet on port 2368; saw 2368: 60";
}

void add_blocks(std::vector<BadInput>& all) {
  for (const auto& [letter, flag] : {std::pair{'a', 0xFFEEU}, {'b', 0xDDFFU}, {'c', 0U}}) {
    for (std::size_t at = 0; at < kBlocksPerPacket; ++at) {
      all.push_back(counted(std::string("V02") + letter + two_digits(at), "Flag" + std::to_string(flag),
                            one_changed([at, wrong = flag](RawPacket& p) {
                              p.blocks[at].flag = static_cast<std::uint16_t>(wrong);
                            }),
                            kAllPoints - kSlotsPerBlock, "blocks of an unknown flag",
                            "1 blocks have a flag that the model does not have"));
    }
  }
  char variant = 'a';
  for (const std::uint16_t azimuth : std::initializer_list<std::uint16_t>{36'000, 36'001, 65'535}) {
    all.push_back(counted(std::string("V03") + variant++, "Azimuth" + std::to_string(azimuth),
                          one_changed([azimuth](RawPacket& p) { p.blocks[5].azimuth = azimuth; }),
                          kAllPoints - kSlotsPerBlock, "blocks beyond 360 degrees",
                          "1 blocks lie beyond 360 degrees"));
  }
  variant = 'a';
  for (const int off : {-100, -9000, 9000, 18'000}) {
    all.push_back(counted(
        std::string("V05") + variant++, "AzimuthOutOfTurn", one_changed([off](RawPacket& p) {
          p.blocks[5].azimuth = static_cast<std::uint16_t>((p.blocks[5].azimuth + off + kTurn) % kTurn);
        }),
        kAllPoints - kSlotsPerBlock, "blocks out of turn", "1 blocks are out of turn"));
  }
}

Capture standing(std::size_t count) {
  return [count] {
    Packets sent = packets_of({.packets = count});
    for (SensorPacket& packet : sent) {
      change(packet, [](RawPacket& p) {
        for (RawBlock& block : p.blocks) {
          block.azimuth = 4321;
          std::fill(block.distance.begin() + 1, block.distance.end(), std::uint16_t{0});
        }
      });
    }
    return capture_of(sent);
  };
}

void add_turns(std::vector<BadInput>& all) {
  all.push_back(input("V04a", "HeadStands", standing(kPackets)));
  all.back().says = "revolution is 0 % complete";
  all.back().used = kPackets * kBlocksPerPacket;
  all.push_back(input("V04b", "HeadStandsFor1300Milliseconds", standing(2400)));
  all.back().used = 2400 * kBlocksPerPacket;
  all.back().scans = 2;
  all.back().warns = "1 scans ended by time: the head stands still";
  for (std::size_t at = 0; at < kBlocksPerPacket; ++at) {
    // At 10 revolutions a second the head turns 0.165888 degrees from block to block.
    const auto before = static_cast<int>(16.5888 * static_cast<double>(30 * kBlocksPerPacket + at)) - 8;
    all.push_back(input("V06a" + two_digits(at), "WrapAtBlock", [before] {
      return capture_of(packets_of({.begin_azimuth = kTurn - before, .packets = kPackets}));
    }));
    all.back().used = kAllPoints;
    all.back().scans = 1;
    all.push_back(input("V06b" + two_digits(at), "CutAtBlock", [before] {
      return capture_of(packets_of({.begin_azimuth = kTurn / 2 - before, .packets = kPackets}));
    }));
    all.back().used = kAllPoints;
    all.back().scans = 2;
  }
  const std::pair<double, std::size_t> rates[] = {{5.0, 2}, {10.0, 3}, {20.0, 5}};
  char variant = 'a';
  for (const auto& [rate_hz, scans] : rates) {
    all.push_back(
        input(std::string("V19") + variant++, "TurnsAMinute" + std::to_string(static_cast<int>(60 * rate_hz)),
              [rate = rate_hz] { return capture_of(packets_of({.rate_hz = rate, .packets = 400})); }));
    all.back().used = 400 * kPacketPoints;
    all.back().scans = scans;
    all.back().counted = {{"blocks out of turn", 0}};
  }
  all.push_back(input("V19d", "StepFrom600To1200TurnsAMinute", [] {
    Packets sent = packets_of({.packets = 200});
    constexpr std::int64_t kPacketNs = 552'960;
    const Packets faster = packets_of({.begin_ns = StreamPlan{}.begin_ns + 200 * kPacketNs,
                                       .rate_hz = 20.0,
                                       .begin_azimuth = (18'000 + 39'813) % kTurn,
                                       .packets = 200});
    sent.insert(sent.end(), faster.begin(), faster.end());
    return capture_of(sent);
  }));
  all.back().used = 400 * kPacketPoints;
  all.back().scans = 4;
  all.back().counted = {{"blocks out of turn", 0}};
}

void add_distances(std::vector<BadInput>& all) {
  struct Case {
    std::string code, title;
    std::uint16_t distance;
    std::string counter;
  };
  for (const Case& c : {Case{"V07", "NoReturnAtAll", 0, "measurements without return"},
                        Case{"V08a", "AllFarthest", 65'535, "measurements too far"},
                        Case{"V08b", "AllJustTooFar", 50'001, "measurements too far"},
                        Case{"V09a", "AllNearest", 1, "measurements too near"},
                        Case{"V09b", "AllJustTooNear", 449, "measurements too near"}}) {
    all.push_back(input(c.code, c.title, all_changed([d = c.distance](RawPacket& p) { set_all(p, d); })));
    all.back().used = 0;
    all.back().scans = 1;
    all.back().counted = {{c.counter, kAllPoints}, {"measurements used", 0}};
  }
}

void add_stamps(std::vector<BadInput>& all) {
  char variant = 'a';
  for (const std::uint32_t stamp : {0U, 3'599'999'999U, 3'600'000'000U, 3'600'060'000U, 0xFFFFFFFFU}) {
    all.push_back(counted(std::string("V10") + variant++, "Stamp" + std::to_string(stamp),
                          one_changed([stamp](RawPacket& p) { p.stamp_us = stamp; }), kAllPoints,
                          "stamps estimated", "1 stamps are of no use and were estimated"));
  }
  constexpr std::int64_t kFullHourNs = 472'222LL * 3'600'000'000'000;
  const StreamPlan over_the_hour{.begin_ns = kFullHourNs - 15'000'000, .packets = kPackets};
  const auto wrapping = [over_the_hour] { return capture_of(packets_of(over_the_hour)); };
  all.push_back(input("V10f", "HourWraps", wrapping));
  all.back().used = kAllPoints;
  all.back().scans = 1;
  all.back().counted = {{"stamps estimated", 0}};
  all.push_back(
      input("V10g", "StampsBeyondTheHourBeforeTheyWrap", [over_the_hour] {  // ros-drivers/velodyne#218
        Packets sent = packets_of(over_the_hour);
        for (SensorPacket& packet : sent) {
          change(packet, [](RawPacket& p) {
            if (p.stamp_us < 10'000) p.stamp_us += 3'600'000'000U;
          });
        }
        return capture_of(sent);
      }));
  all.back().counted = {{"stamps estimated", 0}};
  all.back().same_as = file("wrapping.pcap", wrapping);
}

void add_models(std::vector<BadInput>& all) {
  all.push_back(
      input("V11", "FactoryBytesOfZero", all_changed([](RawPacket& p) { p.mode = p.product = 0; })));
  all.back().same_as = file("clean.pcap", &clean);
  const auto vlp16 = [] { return capture_of(packets_of({.model = Model::kVlp16, .packets = kPackets})); };
  all.push_back(input("V12a", "Vlp16", vlp16));
  all.back().used = kAllPoints;
  all.back().counted = {{"packets of another model", 0}};
  const std::pair<std::string, Capture> forced[] = {{"hdl32e", vlp16}, {"vlp16", &clean}, {"hdl64e", &clean}};
  char variant = 'b';
  for (const auto& [model, capture] : forced) {
    all.push_back(input(std::string("V12") + variant++, "AnotherModelForced", capture, kUnusable));
    all.back().model = model;
    all.back().says = "no data packet can be decoded (got 60 of 60 packets are of another model)";
    all.back().where = std::to_string(kCaptureHeader);
  }
  all.push_back(input("V12e", "NoSuchModelForced", &clean, kUsage));
  all.back().model = "vlp17";
  all.back().says = "no such Velodyne model";
  const auto product = [](std::uint8_t byte) { return [byte](RawPacket& p) { p.product = byte; }; };
  struct Case {
    std::string code, title;
    std::size_t first, end;
    std::uint8_t product;
  };
  // Packets that are left out are damage: their points are missing, and the rest is there.
  for (const Case& c :
       {Case{"V12f", "OnePacketOfAVlp16", 30, 31, 0x22}, Case{"V12g", "FirstPacketOfAVlp16", 0, 1, 0x22},
        Case{"V12h", "LastThirdOfAVlp16", 40, 60, 0x22},
        Case{"V12i", "OnePacketOfAnUnknownModel", 30, 31, 0x24}}) {
    all.push_back(input(c.code, c.title, changed(c.first, c.end, product(c.product)), kDamaged));
    all.back().used = kAllPoints - (c.end - c.first) * kPacketPoints;
    all.back().says = "packets of another model are left out (got " + std::to_string(c.end - c.first) +
                      " of 60 packets, need hdl32e)";
    all.back().where = std::to_string(record_at(c.first));
    all.back().counted = {{"packets of another model", c.end - c.first}};
  }
  all.push_back(input("V12j", "AllOfAnUnknownModel", all_changed(product(0x24)), kUnusable));
  all.back().says = "60 of 60 packets are of another model";
}

void make_dual(RawPacket& packet) {
  packet.mode = sensor::velodyne::kModeDual;
  for (std::size_t b = 1; b < kBlocksPerPacket; b += 2) {
    packet.blocks[b].azimuth = packet.blocks[b - 1].azimuth;
    for (std::uint16_t& distance : packet.blocks[b].distance) ++distance;
  }
}

void add_modes(std::vector<BadInput>& all) {
  for (const std::size_t block : {0U, 3U, 11U}) {
    all.push_back(counted(
        "V13b" + two_digits(block), "OddNumberOfBlocksInDualMode",
        [block] {
          Packets sent = packets();
          for (SensorPacket& packet : sent) change(packet, &make_dual);
          change(sent[30], [block](RawPacket& p) { p.blocks[block].flag = 0; });
          return capture_of(sent);
        },
        kAllPoints - kSlotsPerBlock, "blocks of an unknown flag", "1 blocks have a flag"));
  }
  all.push_back(input("V14a", "FromOneEchoToTwo", changed(30, kPackets, &make_dual)));
  all.push_back(input("V14b", "FromTwoEchoesToOne", changed(0, 30, &make_dual)));
  all.push_back(input("V14c", "TwoEchoesInOnePacket", one_changed(&make_dual)));
  all.push_back(input("V14d", "ModeThatIsNone", one_changed([](RawPacket& p) { p.mode = 0xFF; })));
  for (auto bad = all.end() - 4; bad != all.end(); ++bad) {
    bad->used = kAllPoints;
    bad->scans = 1;
    bad->counted = {{"measurements of the same echo", 0}};
  }
}

void add_order(std::vector<BadInput>& all) {
  const auto moved = [](const std::function<void(Packets&)>& move) {
    return [move] {
      Packets sent = packets_of({.packets = 240});
      move(sent);
      return capture_of(sent);
    };
  };
  const auto whole = moved([](Packets&) {});
  char variant = 'a';
  for (const std::size_t later : {1U, 5U, 15U}) {
    all.push_back(input(std::string("V15") + variant++, "SentTwice", moved([by = later](Packets& sent) {
                          sent.insert(sent.begin() + 100 + static_cast<std::ptrdiff_t>(by), sent[100]);
                        })));
    all.back().same_as = file("whole.pcap", whole);
    all.back().counted = {{"packets sent twice", 1}};
  }
  all.push_back(input("V16", "OfTheRevolutionBefore", moved([](Packets& sent) {
                        const SensorPacket old = sent[30];
                        sent.erase(sent.begin() + 30);
                        sent.insert(sent.begin() + 220, old);
                      })));
  all.back().same_as = file("whole.pcap", moved([](Packets& sent) { sent.erase(sent.begin() + 30); }));
  all.back().counted = {{"packets too late", 1}};
  all.back().warns = "1 packets came too late to be used";
  variant = 'a';
  for (const std::size_t apart : {1U, 8U, 15U}) {
    all.push_back(input(std::string("V17") + variant++, "Swapped",
                        moved([by = apart](Packets& sent) { std::swap(sent[100], sent[100 + by]); })));
    all.back().same_as = file("whole.pcap", whole);
    all.back().counted = {{"packets too late", 0}, {"packets sent twice", 0}};
  }
}

/// 20 bytes of blocks changed anywhere: what stands there is counted or is a point, and nothing else happens.
void add_flips(std::vector<BadInput>& all) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    all.push_back(input("V18s" + two_digits(seed), "TwentyBytesChanged", [seed] {
      std::mt19937 random(seed);
      Packets sent = packets();
      for (int i = 0; i < 20; ++i) {
        std::string& payload = sent[random() % kPackets].payload;
        payload[random() % 1200] = static_cast<char>(random());
      }
      return capture_of(sent);
    }));
    all.back().counted = {{"packets used", kPackets}};
  }
}

std::string calibration(int lasers) {
  std::string text = "lasers:\n";
  for (int i = 0; i < lasers; ++i) {
    text += "- {laser_id: " + std::to_string(i) + ", vert_correction: " + std::to_string(0.01 * i) + "}\n";
  }
  return text;
}

void add_calibrations(std::vector<BadInput>& all) {
  const auto replaced = [](const std::string& what, const std::string& with) {
    std::string text = calibration(32);
    return text.replace(text.find(what), what.size(), with);
  };
  struct Case {
    std::string code, title, text;
    Exit exit;
    std::string says, where;
  };
  const Case cases[] = {
      {"V20a", "Lasers31", calibration(31), kUsage, "of another sensor (got 31 lasers, need 32 lasers)", ""},
      {"V20b", "Lasers33", calibration(33), kUsage, "of another sensor (got 33 lasers, need 32 lasers)", ""},
      {"V20c", "IdTwice", replaced("laser_id: 7,", "laser_id: 6,"), kUnusable, "laser_id comes twice (got 6)",
       "9:1"},
      {"V20d", "IdOfMinus1", replaced("laser_id: 7,", "laser_id: -1,"), kUnusable, "no such laser_id (got -1",
       "9:4"},
      {"V20e", "AngleIsNan", replaced("0.070000", "nan"), kUnusable,
       "vert_correction is not a finite number (got nan)", "9:16"},
      {"V20f", "TwoEqualAngles", replaced("0.070000", "0.060000"), kUnusable, "lasers 6 and 7", "9:1"},
      {"V20g", "NoId", replaced("laser_id: 7,", ""), kUnusable, "laser_id is missing", "9:1"},
      {"V20h", "Empty", "", kUnusable, "no lasers in the calibration", "1:1"},
      {"V20i", "NoText", std::string(100, '\xFF'), kUnusable, "no lasers in the calibration", "1:1"}};
  for (const Case& c : cases) {
    all.push_back({.code = c.code,
                   .title = c.title,
                   .make =
                       [text = c.text](const std::filesystem::path& folder) {
                         write(folder / "V.yaml", text);
                         return file("V.pcap", &clean)(folder);
                       },
                   .exit = c.exit,
                   .says = c.says,
                   .where = c.where,
                   .calibration = "V.yaml"});
  }
  all.push_back(input("V20j", "Missing", &clean, kCannotOpen));
  all.back().calibration = "none.yaml";
  all.back().says = "none.yaml: cannot open";
}

}  // namespace

std::vector<BadInput> bad_inputs_velodyne() {
  std::vector<BadInput> all;
  add_sizes(all);
  add_blocks(all);
  add_turns(all);
  add_distances(all);
  add_stamps(all);
  add_models(all);
  add_modes(all);
  add_order(all);
  add_flips(all);
  add_calibrations(all);
  return all;
}

}  // namespace verge::faults
