// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// The catalogue of bad inputs: sections G (any file), K (KITTI, nuScenes), C (PCD), Y (PLY), S (CSV),
// L (ibeo), A (LAS), R (recordings of ROS), P (pcap, pcapng), V (data packets of an HDL-32E) and N (its
// position packets) of the contract that docs/reliability.md states. Each is generated, and each says how the
// program has to end.

namespace verge::faults {

/// Exit codes of the program.
enum Exit : int {
  kGood = 0,
  kUsage = 2,
  kCannotOpen = 3,
  kUnusable = 4,
  kDamaged = 5,
  kTimeout = 7,
  kLimit = 8,
};

/// One bad input and what has to become of it.
struct BadInput {
  std::string code;   ///< Of the catalogue, with a letter for a variant: "C06b".
  std::string title;  ///< What is wrong, as one CamelCase word.
  /// Makes it below the folder and says the path to open. A folder means that it is a recording.
  std::function<std::filesystem::path(const std::filesystem::path& folder)> make;
  Exit exit = kUnusable;
  std::string says{};                    ///< Has to stand in the error's line (or, at kGood, in a note).
  std::string where{};                   ///< Has to stand behind the file's name; empty: whatever.
  std::optional<std::size_t> used{};     ///< Points that have to come out (at kGood and kDamaged).
  std::optional<std::size_t> dropped{};  ///< Points that have to be counted as dropped.
  std::string format{};                  ///< Forced (--format); empty: guessed.
  std::size_t memory_mib = 0;            ///< Ceiling to run it with (--max-mem); 0: the usual one.
  bool as_user = false;                  ///< Proves nothing to a superuser: run it as somebody else.
  std::size_t errors = 1;                ///< How many there are (at kDamaged).
  std::map<std::string, std::uint64_t> counted{};  ///< Of the recording's counters, some.

  // Of recordings.
  std::string sensor_ip{};             ///< --sensor-ip; empty: none.
  std::string model{};                 ///< --model; empty: none.
  std::string calibration{};           ///< --calibration: a file that make() makes beside the input.
  std::optional<std::size_t> scans{};  ///< Scans that have to come out.
  std::string warns{};                 ///< Has to stand in a warning's line.
  /// Another input, of which the very same scans have to come.
  std::function<std::filesystem::path(const std::filesystem::path& folder)> same_as{};
};

/// The inputs of one section, whose codes get a letter for each variant.
class Section {
 public:
  explicit Section(char letter) : letter_(letter) {}
  /// Another variant of number `number`; its code is filled in.
  void add(int number, BadInput input);
  [[nodiscard]] std::vector<BadInput> take() && { return std::move(all_); }

 private:
  char letter_;
  std::map<int, int> variants_;
  std::vector<BadInput> all_;
};

/// A file of these bytes.
[[nodiscard]] std::function<std::filesystem::path(const std::filesystem::path&)> file(std::string name,
                                                                                      std::string bytes);
/// A file of the bytes that are made when it is: captures are large.
[[nodiscard]] std::function<std::filesystem::path(const std::filesystem::path&)> file(
    std::string name, std::function<std::string()> bytes);
/// A folder of these files.
[[nodiscard]] std::function<std::filesystem::path(const std::filesystem::path&)> folder(
    std::string name, std::vector<std::pair<std::string, std::string>> files);
/// Writes bytes, and makes the folders that are missing.
void write(const std::filesystem::path& path, const std::string& bytes);

[[nodiscard]] std::vector<BadInput> bad_inputs_any();
[[nodiscard]] std::vector<BadInput> bad_inputs_bin();
[[nodiscard]] std::vector<BadInput> bad_inputs_pcd();
[[nodiscard]] std::vector<BadInput> bad_inputs_ply();
[[nodiscard]] std::vector<BadInput> bad_inputs_csv();
[[nodiscard]] std::vector<BadInput> bad_inputs_ibeo();
[[nodiscard]] std::vector<BadInput> bad_inputs_las();
[[nodiscard]] std::vector<BadInput> bad_inputs_ros();
[[nodiscard]] std::vector<BadInput> bad_inputs_pcap();
[[nodiscard]] std::vector<BadInput> bad_inputs_velodyne();
[[nodiscard]] std::vector<BadInput> bad_inputs_position();

/// All of them.
[[nodiscard]] std::vector<BadInput> bad_inputs();

}  // namespace verge::faults
