// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section K: KITTI and nuScenes .bin.
#include <cmath>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/samples.hpp"

namespace verge::faults {
namespace {

/// `bytes` with the float at number `index` replaced.
std::string with_float(std::string bytes, std::size_t index, float value) {
  return bytes.replace(index * 4, 4, packed(value));
}

void add_sizes(std::vector<BadInput>& all, const std::vector<SamplePoint>& points) {
  const std::string four = kitti(points);
  const std::string five = nuscenes(points);
  for (const std::size_t cut : {1U, 4U, 15U}) {
    all.push_back({"K01k" + std::to_string(cut), "KittiOfNoWholePoints",
                   file("K01.bin", four.substr(0, four.size() - cut)), kUnusable, "need a multiple of 16 B",
                   std::to_string(four.size() - 16)});
    all.push_back({"K01n" + std::to_string(cut), "NuscenesOfNoWholePoints",
                   file("K01.pcd.bin", five.substr(0, five.size() - cut)), kUnusable,
                   "need a multiple of 20 B", std::to_string(five.size() - 20)});
  }
  all.push_back({"K01f",
                 "KittiForcedOnNuscenesSize",
                 file("K01.bin", five.substr(0, 20)),
                 kUnusable,
                 "need a multiple of 16 B",
                 "16",
                 {},
                 {},
                 "kitti"});
}

void add_sizes_of_both(std::vector<BadInput>& all, const std::vector<SamplePoint>& points) {
  const std::string zeros(800, '\0');
  all.push_back(
      {"K02a", "Divisible80IsKittiByContent", file("K02.bin", kitti(points)), kGood, "", "", 200, 0});
  all.push_back(
      {"K02b", "Divisible80IsNuscenesByContent", file("K02.bin", nuscenes(points)), kGood, "", "", 200, 0});
  all.push_back(
      {"K02c", "Divisible80FitsBoth", file("K02.bin", zeros), kUsage, "kitti and nuscenes fit alike"});
  all.push_back({"K02d", "Divisible80IsNuscenesByName", file("K02.pcd.bin", zeros), kGood, "", "", 40, 0});
  all.push_back(
      {"K02e", "Divisible80IsKittiByFolder", file("velodyne/K02.bin", zeros), kGood, "", "", 50, 0});
  all.push_back({"K02f", "Divisible80IsForced", file("K02.bin", zeros), kGood, "", "", 40, 0, "nuscenes"});
}

void add_numbers(std::vector<BadInput>& all, const std::vector<SamplePoint>& points) {
  const std::vector<std::pair<std::string, float>> bad{{"Nan", NAN},
                                                       {"Infinity", INFINITY},
                                                       {"MinusInfinity", -INFINITY},
                                                       {"Huge", 1e38F},
                                                       {"Denormal", 1e-40F}};
  char variant = 'a';
  for (const auto& [name, value] : bad) {
    std::string four = kitti(points);
    std::string five = nuscenes(points);
    for (const std::size_t column : {0U, 1U, 2U}) {  // x of point 10, y of point 11, z of point 12
      four = with_float(std::move(four), (10 + column) * 4 + column, value);
      five = with_float(std::move(five), (10 + column) * 5 + column, value);
    }
    all.push_back({std::string("K03k") + variant, "KittiCoordinateIs" + name, file("K03.bin", four), kGood,
                   "", "", 197, 3});
    all.push_back({std::string("K03n") + variant++, "NuscenesCoordinateIs" + name, file("K03.pcd.bin", five),
                   kGood, "", "", 197, 3});
  }
  variant = 'a';
  for (const float intensity : {-1.0F, 2.0F, 300.0F, NAN, INFINITY}) {
    all.push_back({std::string("K04k") + variant, "KittiIntensityOutOfRange",
                   file("K04.bin", with_float(kitti(points), 43, intensity)), kGood, "", "", 200, 0});
    all.push_back({std::string("K04n") + variant++, "NuscenesIntensityOutOfRange",
                   file("K04.pcd.bin", with_float(nuscenes(points), 53, intensity)), kGood, "", "", 200, 0});
  }
}

void add_rings(std::vector<BadInput>& all, const std::vector<SamplePoint>& points) {
  const std::vector<std::pair<std::string, float>> rings{
      {"Is32", 32.0F}, {"Is33", 33.0F},   {"IsMinus1", -1.0F}, {"Is3AndAHalf", 3.5F},
      {"IsNan", NAN},  {"Is128", 128.0F}, {"IsHuge", 1e20F}};
  char variant = 'a';
  for (const auto& [name, ring] : rings) {
    const bool good = ring == 32.0F || ring == 33.0F;  // other sensors have more rings than the HDL-32E
    all.push_back({std::string("K05") + variant++, "Ring" + name,
                   file("K05.pcd.bin", with_float(nuscenes(points), 54, ring)), kGood,
                   good ? "" : "no valid ring", "", good ? 200 : 199, good ? 0 : 1});
  }
  std::string none = nuscenes(points);
  for (std::size_t i = 0; i < points.size(); ++i) none = with_float(std::move(none), 5 * i + 4, 0.5F);
  all.push_back(
      {"K05x", "NoPointHasARing", file("K05.pcd.bin", none), kUnusable, "no ring", "", {}, {}, "nuscenes"});
}

}  // namespace

std::vector<BadInput> bad_inputs_bin() {
  const std::vector<SamplePoint> points = sample_points(4, 50);
  std::vector<BadInput> all;
  add_sizes(all, points);
  add_sizes_of_both(all, points);
  add_numbers(all, points);
  add_rings(all, points);
  all.push_back({"K06a", "KittiOf0Points", file("K06.bin", ""), kDamaged, "0 points", "0", {}, {}, "kitti"});
  all.push_back(
      {"K06b", "NuscenesOf0Points", file("K06.pcd.bin", ""), kDamaged, "0 points", "0", {}, {}, "nuscenes"});
  all.push_back({"K06c", "OneOf0PointsInAFolder",
                 folder("K06", {{"1.bin", kitti(points)}, {"2.bin", ""}, {"3.bin", kitti(points)}}), kDamaged,
                 "2.bin:0: is empty", "", 400});
  all.push_back(
      {"K07a", "KittiBigEndian", file("K07.bin", swapped(kitti(points))), kUnusable, "big-endian", "0"});
  all.push_back({"K07b", "NuscenesBigEndian", file("K07.pcd.bin", swapped(nuscenes(points))), kUnusable,
                 "big-endian", "0"});
  return all;
}

}  // namespace verge::faults
