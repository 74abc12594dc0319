// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/number_range.hpp"
#include "apps/verge/options.hpp"
#include "apps/verge/scenario_file.hpp"
#include "apps/verge/signals.hpp"
#include "apps/verge/simulate_job.hpp"
#include "verge/core/field_io.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge simulate --list                             # the scenarios that there are\n"
    "  verge simulate campus -o drive                    # scans, truth.jsonl and labels in drive/\n"
    "  verge simulate --seed 7 -o random                 # a scenario drawn by the seed\n"
    "  verge simulate crossing --dump > mine.toml        # a scenario as a file, to be edited ...\n"
    "  verge simulate mine.toml -o mine --noise-m 0.05   # ... and driven with a worse sensor\n"
    "  verge simulate paper2 -o lux --sensor lux         # an ibeo LUX: lux/recording.idc\n"
    "  verge simulate street -o vlp --sensor vlp16 --format pcap --set weather.rain_mmph=20\n";

constexpr std::size_t kUsualScans = 120;
constexpr std::int64_t kBeginNs = 1'767'258'000'000'000'000;  // 2026-01-01 09:00 UTC

Error usage_error(std::string what) { return {ErrorCode::kUsage, {}, {}, std::move(what), {}, {}}; }

bool is_file(const std::string& scenario) { return scenario.ends_with(".toml"); }

Expected<sim::Scenario> scenario_of(const SimulateRequest& request) {
  if (!request.scenario && !request.seed) {
    return Unexpected(usage_error("name a SCENARIO (verge simulate --list), a .toml file, or a --seed"));
  }
  if (request.scenario && is_file(*request.scenario)) return read_scenario(*request.scenario);
  sim::Scenario scenario;
  try {
    scenario =
        request.scenario ? sim::ready_scenario(*request.scenario) : sim::random_scenario(*request.seed);
  } catch (const std::invalid_argument& error) {
    return Unexpected(usage_error(error.what()));
  }
  return scenario;
}

// --set noise.KEY=VALUE and weather.KEY=VALUE.
Expected<void> apply_settings(const SimulateRequest& request, sim::DriveConfig& config) {
  for (const std::string& assignment : request.set) {
    const std::size_t equals = assignment.find('=');
    const std::size_t dot = assignment.substr(0, equals).find('.');
    const std::string section = assignment.substr(0, dot);
    Error fault = usage_error("is not noise.KEY=VALUE or weather.KEY=VALUE, as in weather.rain_mmph=20");
    fault.file = "--set " + assignment;
    if (equals == std::string::npos || dot == std::string::npos) return Unexpected(fault);
    const std::string key = assignment.substr(dot + 1, equals - dot - 1);
    try {
      if (section == "noise") {
        set_field(config.noise, key, assignment.substr(equals + 1));
      } else if (section == "weather") {
        set_field(config.scenario.weather, key, assignment.substr(equals + 1));
      } else {
        return Unexpected(fault);
      }
    } catch (const std::invalid_argument& error) {
      fault.what = error.what();
      return Unexpected(fault);
    }
  }
  return {};
}

Expected<sim::DriveConfig> drive_of(const SimulateRequest& request) {
  auto scenario = scenario_of(request);
  if (!scenario) return Unexpected(scenario.error());
  sim::DriveConfig config;
  config.stamp_begin_ns = kBeginNs;
  config.scenario = *std::move(scenario);
  if (request.speed_kmh) config.scenario.course.speed_mps = *request.speed_kmh / 3.6;
  if (request.scenario && request.seed) {
    config.scenario.ground.seed = static_cast<std::int64_t>(*request.seed % 1'000'000'007ULL);
  }
  config.noise.seed = request.seed.value_or(1);
  if (request.noise_m) config.noise.range_sigma_m = *request.noise_m;
  if (auto applied = apply_settings(request, config); !applied) return Unexpected(applied.error());
  try {
    config.sensor = sim::sensor_named(request.sensor, request.rate_hz);
  } catch (const std::invalid_argument& error) {
    return Unexpected(usage_error(error.what()));
  }
  return config;
}

/// The world of a configuration, or why it makes none.
Expected<std::unique_ptr<sim::Drive>> make_drive(const SimulateRequest& request, sim::DriveConfig config) {
  try {
    return std::make_unique<sim::Drive>(std::move(config));
  } catch (const std::invalid_argument& error) {
    Error fault = usage_error(error.what());
    fault.file = request.scenario.value_or("--seed");
    return Unexpected(std::move(fault));
  }
}

// How many scans are made: as many as were asked for, or as the way has, up to 120.
Expected<std::size_t> scans_of(const SimulateRequest& request, const sim::Drive& drive) {
  const auto way_m = drive.way_m();
  if (!way_m) return request.scans.value_or(kUsualScans);
  const double seconds = *way_m / drive.config().scenario.course.speed_mps;
  const auto most = static_cast<std::size_t>(
      std::max(0.0, 1e9 * seconds / static_cast<double>(drive.config().sensor.period_ns)));
  if (most == 0) return Unexpected(usage_error("the vehicle's way ends before the first scan is over"));
  if (request.scans.value_or(0) <= most) return std::min(request.scans.value_or(kUsualScans), most);
  Error fault = usage_error("the vehicle's way ends before the last scan");
  fault.got = fmt::format("--scans {}", *request.scans);
  fault.need = fmt::format("<= {}", most);
  return Unexpected(std::move(fault));
}

ExitCode failed(Console& console, const Error& error) {
  console.error(error);
  return exit_code_of(error.code);
}

ExitCode simulate(const SimulateRequest& request) {
  Console console(request.console);
  const Signals signals;
  if (request.folder.empty()) return failed(console, usage_error("name a new folder with -o DIR"));
  auto config = drive_of(request);
  if (!config) return failed(console, config.error());
  const auto format = format_of(request.format, config->sensor);
  if (!format) return failed(console, format.error());
  const auto drive = make_drive(request, *std::move(config));
  if (!drive) return failed(console, drive.error());
  const auto scans = scans_of(request, **drive);
  if (!scans) return failed(console, scans.error());
  if (const auto done = write_drive(request, **drive, *format, *scans, console, signals); !done) {
    return failed(console, done.error());
  }
  return signals.stop() ? signals.exit_code() : ExitCode::kOk;
}

std::string list_of_scenarios() {
  std::size_t width = 0;
  for (const sim::ReadyScenario& ready : sim::ready_scenarios()) width = std::max(width, ready.name.size());
  std::string text;
  for (const sim::ReadyScenario& ready : sim::ready_scenarios()) {
    text += fmt::format("{:{}}  {}\n", ready.name, width, ready.about);
  }
  return text;
}

ExitCode dump(const SimulateRequest& request) {
  const auto config = drive_of(request);
  if (config) return print_data(to_toml(config->scenario));
  print_error(config.error());
  return exit_code_of(config.error().code);
}

std::string noise_keys() {
  return fmt::format("\nnot in a file, but --set noise.KEY=VALUE\n{}",
                     to_table(field_rows(sim::NoiseConfig{})));
}

ExitCode run(const SimulateRequest& request) {
  if (request.list) return print_data(list_of_scenarios());
  if (request.keys) return print_data(scenario_keys() + noise_keys());
  return request.dump ? dump(request) : simulate(request);
}

std::string sensor_names() {
  std::vector<std::string_view> names;
  for (const sim::SensorEntry& entry : sim::sensors()) names.push_back(entry.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void add_shows(CLI::App& verb, SimulateRequest& request) {
  verb.add_flag("--list", request.list, "say which scenarios there are, and do nothing else");
  verb.add_flag("--keys", request.keys, "say what can stand in a scenario file, and do nothing else");
  verb.add_flag("--dump", request.dump, "print the scenario as a file, and do nothing else");
}

void add_options(CLI::App& verb, SimulateRequest& request) {
  verb.add_option("SCENARIO", request.scenario, "name of a scenario, or a .toml file");
  verb.add_option("-o,--output", request.folder,
                  "new folder for the scans (LIDAR_TOP/*.pcd.bin, or as --format says), the labels of their "
                  "points, truth.jsonl, poses.csv and scenario.toml")
      ->type_name("DIR");
  verb.add_option("--sensor", request.sensor, "what sees it: " + sensor_names())
      ->type_name("S")
      ->capture_default_str();
  verb.add_option("--rate-hz", request.rate_hz, "scans a second, instead of the sensor's usual ones")
      ->type_name("F")
      ->check(finite_range(1.0, 100.0));
  verb.add_option(
          "--format", request.format,
          "how scans are written: nuscenes (usual), kitti, pcap, idc (usual of a LUX), alasca, mcap, pcd, "
          "ply, csv, las")
      ->type_name("F");
  verb.add_option("--scans", request.scans, "how many; else the vehicle's whole way, up to 120")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000));
  verb.add_option(
          "--seed", request.seed,
          "of noise and bumps, and without a SCENARIO of the whole world; the same seed gives the same bytes")
      ->type_name("N")
      ->check(finite_range(0.0, 0x1p64));
  verb.add_option("--speed-kmh", request.speed_kmh, "of the vehicle, instead of the scenario's")
      ->type_name("V")
      ->check(finite_range(0.0, 200.0));
  verb.add_option("--noise-m", request.noise_m, "deviation of the noise of each range, instead of 0.02")
      ->type_name("M")
      ->check(finite_range(0.0, 1.0));
  verb.add_option("--set", request.set, "a value of the sensor's noise or the weather (--keys), repeatable")
      ->type_name("noise|weather.KEY=VALUE");
  verb.add_flag("--skewed", request.skewed,
                "points where the moving sensor saw them, as recordings have them anyway; without it the "
                "motion is taken "
                "out of nuScenes' and KITTI's files, as those data sets do it");
  verb.add_option("--plot", request.plot, "also one bird's-eye picture a scan with its truth (PNG)")
      ->type_name("FOLDER");
  add_shows(verb, request);
  add_console_options(verb, request.console);
}

}  // namespace

void add_simulate(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("simulate", "drive through a made-up world, with its truth");
  const auto request = std::make_shared<SimulateRequest>();
  add_options(*verb, *request);
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] { action = [request] { return run(*request); }; });
}

}  // namespace verge::app
