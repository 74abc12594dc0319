// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/detect/detector.hpp"
#include "verge/pipeline/run.hpp"

// The two stages of run() between its ends, for whoever shows one scan to several detectors.

namespace verge::pipeline {

/// Takes the motion out of the frame's scan and gives it its mount.
void prepare(Frame& frame, const Options& options);

/// What the detector says of a prepared frame, with the scan's name and the method's.
void detect_on(Frame& frame, detect::Detector& detector, const Options& options);

}  // namespace verge::pipeline
