// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Scenes of known scans against the files beside this one: a change that was not meant shows where it is.
// After one that was meant: run with VERGE_GOLDEN_UPDATE=1, look at the pictures, commit the files.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/laws/law_scans.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/emit/scene_json.hpp"

namespace verge {
namespace {

using Json = nlohmann::json;

// Another compiler may round a sum otherwise.
constexpr double kTolerance = 0.002;

std::filesystem::path golden_file(const std::string& name) {
  return std::filesystem::path(VERGE_GOLDEN_FOLDER) / (name + ".json");
}

// One boundary a line, so that a difference between two versions of the file can be read.
std::string as_file(const Json& scene) {
  std::string text = "{\"boundaries\": [";
  const char* comma = "\n";
  for (const Json& boundary : scene.at("boundaries")) {
    text += comma + boundary.dump();
    comma = ",\n";
  }
  return text + "\n]}\n";
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return Json::parse(text.str());
}

bool agree(const Json& a, const Json& b) {
  if (!a.is_number() || !b.is_number()) return a == b;
  return std::abs(a.get<double>() - b.get<double>()) <= kTolerance;
}

// "/boundaries/0/points/3/1: golden 3.98, now 4.03", for the first few places that differ.
std::string differences(const Json& golden, const Json& now) {
  constexpr int kMost = 10;
  const Json was = golden.flatten();
  const Json is = now.flatten();
  std::string text;
  int count = 0;
  const auto report = [&](const std::string& path, const std::string& a, const std::string& b) {
    if (++count <= kMost) text += path + ": golden " + a + ", now " + b + "\n";
  };
  for (const auto& [path, value] : was.items()) {
    if (!is.contains(path)) {
      report(path, value.dump(), "nothing");
    } else if (!agree(value, is.at(path))) {
      report(path, value.dump(), is.at(path).dump());
    }
  }
  for (const auto& [path, value] : is.items()) {
    if (!was.contains(path)) report(path, "nothing", value.dump());
  }
  return count > kMost ? text + "and " + std::to_string(count - kMost) + " more\n" : text;
}

}  // namespace

TEST(Golden, ADifferenceIsSaidWithItsPlace) {
  const Json golden = Json::parse(R"({"a": [1.0, 2.0], "b": "left"})");
  EXPECT_EQ(differences(golden, golden), "");
  EXPECT_EQ(differences(golden, Json::parse(R"({"a": [1.001, 2.5], "b": "left"})")),
            "/a/1: golden 2.0, now 2.5\n");
  EXPECT_EQ(differences(golden, Json::parse(R"({"a": [1.0], "b": "right"})")),
            "/a/1: golden 2.0, now nothing\n/b: golden \"left\", now \"right\"\n");
}

TEST(Golden, TheGradientMethodSaysOfSimulatedScansWhatItSaid) {
  for (const laws::Subject& subject : laws::simulated_subjects()) {
    Scan scan = organise(subject.cloud).scan;
    const Json now = Json::parse(as_file(Json::parse(emit::to_json_line(detect::Gradient{}.process(scan)))));
    if (std::getenv("VERGE_GOLDEN_UPDATE") != nullptr)
      std::ofstream(golden_file(subject.name)) << as_file(now);
    ASSERT_TRUE(std::filesystem::exists(golden_file(subject.name))) << subject.name;
    const Json golden = read_json(golden_file(subject.name));
    EXPECT_GE(golden.at("boundaries").size(), 2U) << "nothing to compare";
    EXPECT_EQ(differences(golden, now), "") << golden_file(subject.name);
  }
}

}  // namespace verge
