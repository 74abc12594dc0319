// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/verge/commands.hpp"
#include "apps/verge/detect_job.hpp"
#include "apps/verge/options.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge detect drive/velodyne -o boundaries.jsonl --plot pictures\n"
    "  verge detect drive/velodyne --frames 0:100 | jq .boundaries\n"
    "  verge detect scan.pcd --geojson kerbs.geojson --origin 48.137,11.575,90\n"
    "  verge detect scan.pcd --set gradient.height_max_m=0.4 --mount roof.toml\n"
    "  verge detect --dump-config > verge.toml    # every setting with its meaning\n";

void add_outputs(CLI::App& verb, OutputRequest& request) {
  verb.add_option("-o,--output", request.jsonl, "JSON lines, one a scan; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  verb.add_option("--geojson", request.geojson, "also one GeoJSON FeatureCollection")->type_name("FILE");
  verb.add_option("--origin", request.origin,
                  "where the first scan stands (degrees; heading clockwise from north): GeoJSON in WGS 84")
      ->type_name("LAT,LON,HEADING");
}

void add_extras(CLI::App& verb, DetectRequest& request) {
  verb.add_option("--plot", request.plot, "also one bird's-eye picture a scan (PNG)")->type_name("FOLDER");
  verb.add_flag("--trace", request.trace, "each record also has every intermediate of the method");
}

void add_settings(CLI::App& verb, SettingsRequest& request) {
  verb.add_option("--method", request.method, "how to look for boundaries (see: verge methods)")
      ->type_name("M");
  verb.add_option("--config", request.config, "settings (see --dump-config)")->type_name("FILE.toml");
  verb.add_option(
          "--mount", request.mount,
          "how the sensor stands: any of height_m, pitch_deg, roll_deg, forward_deg; the rest is estimated")
      ->type_name("FILE.toml");
  verb.add_option("--set", request.set,
                  "one setting, as in gradient.height_max_m=0.4; may stand several times")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void add_detect(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("detect", "find the road's boundaries in scans");
  const auto request = std::make_shared<DetectRequest>();
  add_input_options(*verb, request->input);
  add_outputs(*verb, request->output);
  add_extras(*verb, *request);
  add_settings(*verb, request->settings);
  verb->add_flag("--dump-config", request->dump_config, "print the settings in effect as TOML and end");
  verb->add_option("-j,--threads", request->threads, "scans worked on at once; 0: as many as the machine can")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  add_damage_options(*verb, request->damage);
  add_console_options(*verb, request->console);
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] { action = [request] { return detect(*request); }; });
}

}  // namespace verge::app
