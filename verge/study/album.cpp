// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/album.hpp"

#include <algorithm>
#include <utility>

#include "verge/pipeline/stages.hpp"

namespace verge::study {

void detect_traced(pipeline::Frame& frame, detect::Detector& detector, const std::string& method) {
  pipeline::Options options{.mount_hint = {}, .mount_config = {}, .method = method, .config_hash = {}};
  options.trace = true;
  pipeline::detect_on(frame, detector, options);
}

Trace only(const Trace& all, std::initializer_list<std::string_view> points,
           std::initializer_list<std::string_view> lines) {
  Trace some;
  for (const std::string_view name : points) {
    if (const Trace::Points* layer = all.find_points(name)) some.points.push_back(*layer);
  }
  for (const Trace::Line& line : all.lines) {
    if (std::ranges::any_of(lines, [&](std::string_view name) { return line.name.starts_with(name); }))
      some.lines.push_back(line);
  }
  return some;
}

Expected<Picture> from_above(std::string caption, const emit::BevContent& content, const Reach& reach) {
  emit::BevPlot::Config config;
  config.size_px = 700;
  config.ahead_m = reach.ahead_m;
  config.behind_m = reach.behind_m;
  config.side_m = reach.side_m;
  if (content.scan.mount) config.up_rad = content.scan.mount->forward_rad;
  return emit::BevPlot(config).png(content).map([&](std::string png) {
    return Picture{std::move(png), std::move(caption)};
  });
}

Album::Album(const Scan& scan) : scan_(scan) {
  bare_.frame = scan.frame;
  bare_.mount = scan.mount;
  bare_.ring_begin = {0};
}

void Album::layers(std::string caption, const Trace& trace, const Reach& reach) {
  add(from_above(std::move(caption), {.scan = bare_, .scene = {}, .trace = &trace}, reach));
}

void Album::found(std::string caption, const Scene& scene, const Scene* truth, const Reach& reach) {
  add(from_above(std::move(caption), {.scan = scan_, .scene = scene, .trace = nullptr, .truth = truth},
                 reach));
}

void Album::add(std::string caption, Expected<std::string> png) {
  add(std::move(png).map([&](std::string bytes) { return Picture{std::move(bytes), std::move(caption)}; }));
}

Expected<std::vector<Picture>> Album::finish() {
  if (fault_) return Unexpected(*std::move(fault_));
  return std::move(pictures_);
}

void Album::add(Expected<Picture> picture) {
  if (picture) {
    pictures_.push_back(*std::move(picture));
  } else if (!fault_) {
    fault_ = std::move(picture).error();
  }
}

}  // namespace verge::study
