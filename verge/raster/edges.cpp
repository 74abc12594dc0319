// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/edges.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace verge::raster {
namespace {

// What the filters answer to a straight step from 0 to 255.
constexpr double kSobelStep = 4.0 * 255.0;
constexpr double kPrewittStep = 3.0 * 255.0;
constexpr double kLaplacianStep = 255.0;

/// OpenCV spreads its loops over threads, and how many is a setting of the whole process, which is not ours
/// to change. A loop of its own of one step runs where it is called, and the loops inside it likewise.
void on_this_thread(const std::function<void()>& work) {
  cv::parallel_for_(cv::Range(0, 1), [&](const cv::Range&) { work(); });
}

/// The picture as OpenCV sees it; both hold the same pixels.
cv::Mat view_of(const Picture& picture) { return cv::Mat(picture.grey).reshape(1, picture.rows); }

cv::Mat smoothed(const cv::Mat& grey, double sigma_px) {
  if (!(sigma_px > 0.0)) return grey;
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, cv::Size(), sigma_px, sigma_px, cv::BORDER_REPLICATE);
  return smooth;
}

/// Marks where the gradient is longer than that. Its parts are (-1, 0, 1) along one direction and `weights`
/// along the other.
void mark_gradient(const cv::Mat& grey, const cv::Matx13f& weights, double longer_than, cv::Mat& edges) {
  const cv::Matx13f slope(-1.0F, 0.0F, 1.0F);
  const cv::Point middle(-1, -1);
  cv::Mat_<short> right;
  cv::Mat_<short> down;
  cv::sepFilter2D(grey, right, CV_16S, slope, weights, middle, 0.0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(grey, down, CV_16S, weights, slope, middle, 0.0, cv::BORDER_REPLICATE);
  const double longer_than2 = longer_than * longer_than;
  std::transform(right.begin(), right.end(), down.begin(), edges.begin<std::uint8_t>(), [=](int x, int y) {
    return static_cast<std::uint8_t>(x * x + y * y > longer_than2 ? 255 : 0);
  });
}

void mark_laplacian(const cv::Mat& grey, double more_than, cv::Mat& edges) {
  cv::Mat_<short> answer;
  cv::Laplacian(grey, answer, CV_16S, 1, 1.0, 0.0, cv::BORDER_REPLICATE);
  std::transform(answer.begin(), answer.end(), edges.begin<std::uint8_t>(),
                 [=](int a) { return static_cast<std::uint8_t>(std::abs(a) > more_than ? 255 : 0); });
}

void filter(const cv::Mat& grey, const EdgeOptions& options, cv::Mat& edges) {
  switch (options.filter) {
    case EdgeFilter::kNone:
      break;
    case EdgeFilter::kCanny:
      cv::Canny(grey, edges, options.low_threshold * kSobelStep, options.threshold * kSobelStep, 3, true);
      break;
    case EdgeFilter::kSobel:
      mark_gradient(grey, {1.0F, 2.0F, 1.0F}, options.threshold * kSobelStep, edges);
      break;
    case EdgeFilter::kPrewitt:
      mark_gradient(grey, {1.0F, 1.0F, 1.0F}, options.threshold * kPrewittStep, edges);
      break;
    case EdgeFilter::kLaplacian:
      mark_laplacian(grey, options.threshold * kLaplacianStep, edges);
      break;
  }
}

}  // namespace

Picture find_edges(const Picture& picture, const EdgeOptions& options) {
  if (options.filter == EdgeFilter::kNone || picture.grey.empty()) return picture;
  Picture found(picture.rows, picture.cols);
  cv::Mat edges = view_of(found);
  on_this_thread([&] { filter(smoothed(view_of(picture), options.gaussian_px), options, edges); });
  return found;
}

}  // namespace verge::raster
