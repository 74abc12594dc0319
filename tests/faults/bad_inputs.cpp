// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/bad_inputs.hpp"

#include <fstream>
#include <stdexcept>
#include <utility>

namespace verge::faults {
namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::function<fs::path(const fs::path&)> file(std::string name, std::string bytes) {
  return [name = std::move(name), bytes = std::move(bytes)](const fs::path& folder) {
    write(folder / name, bytes);
    return folder / name;
  };
}

std::function<fs::path(const fs::path&)> file(std::string name, std::function<std::string()> bytes) {
  return [name = std::move(name), bytes = std::move(bytes)](const fs::path& folder) {
    write(folder / name, bytes());
    return folder / name;
  };
}

std::function<fs::path(const fs::path&)> folder(std::string name,
                                                std::vector<std::pair<std::string, std::string>> files) {
  return [name = std::move(name), files = std::move(files)](const fs::path& in) {
    fs::create_directories(in / name);
    for (const auto& [below, bytes] : files) write(in / name / below, bytes);
    return in / name;
  };
}

void Section::add(int number, BadInput input) {
  const auto variant = static_cast<char>('a' + variants_[number]++);
  input.code = letter_ + std::string(number < 10 ? "0" : "") + std::to_string(number) + variant;
  all_.push_back(std::move(input));
}

std::vector<BadInput> bad_inputs() {
  std::vector<BadInput> all;
  for (auto* section :
       {&bad_inputs_any, &bad_inputs_bin, &bad_inputs_pcd, &bad_inputs_ply, &bad_inputs_csv, &bad_inputs_ibeo,
        &bad_inputs_las, &bad_inputs_ros, &bad_inputs_pcap, &bad_inputs_velodyne, &bad_inputs_position}) {
    for (BadInput& input : section()) all.push_back(std::move(input));
  }
  return all;
}

}  // namespace verge::faults
