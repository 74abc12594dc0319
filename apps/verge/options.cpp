// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/options.hpp"

#include <map>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace verge::app {

void add_input_options(CLI::App& verb, InputRequest& request) {
  verb.add_option("SCANS", request.paths, "files or folders of scans; - is standard input");
  add_recording_options(verb, request);
}

void add_recording_options(CLI::App& verb, InputRequest& request) {
  verb.add_option(
          "--format", request.format,
          fmt::format("read as this instead of guessing: {}", fmt::join(enum_names<io::Format>, ", ")))
      ->type_name("F");
  verb.add_option("--topic", request.topic, "of a bag with scans on several topics")->type_name("T");
  verb.add_option("--sensor-ip", request.sensor_ip, "of a capture with packets of several sensors")
      ->type_name("ADDRESS");
  verb.add_option("--model", request.model, "of the sensor, where its packets do not say it")->type_name("M");
  verb.add_option("--calibration", request.calibration,
                  "angles of the sensor's lasers or layers (lasers: laser_id, vert_correction, ...)")
      ->type_name("FILE");
  verb.add_option("--poses", request.poses,
                  "where the sensor was, where the recording does not say it: CSV with frame, x_m, y_m, z_m, "
                  "qw, qx, qy, qz, stamp_ns")
      ->type_name("FILE.csv");
  verb.add_option("--frames", request.frames,
                  "only the scans A to B - 1, counted from 0; either may be missing")
      ->type_name("A:B");
  verb.add_option("--max-mem", request.max_mem_mib, "most memory that one scan may take")
      ->type_name("MIB")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20));
}

void add_damage_options(CLI::App& verb, DamagePolicy& policy) {
  auto* allow = verb.add_flag("--allow-damaged", policy.allow, "damaged scans do not make the run fail");
  verb.add_flag("--strict", policy.strict, "one damaged scan makes the run fail, without output")
      ->excludes(allow);
}

void add_console_options(CLI::App& verb, Console::Options& options) {
  const std::map<std::string, ProgressMode> modes{
      {"auto", ProgressMode::kAuto}, {"always", ProgressMode::kAlways}, {"never", ProgressMode::kNever}};
  verb.add_option("--progress", options.progress, "progress line: auto (on a terminal), always or never")
      ->type_name("WHEN")
      ->transform(CLI::CheckedTransformer(modes).description(""));
  verb.add_flag("--quiet", options.quiet, "errors and warnings only");
}

}  // namespace verge::app
