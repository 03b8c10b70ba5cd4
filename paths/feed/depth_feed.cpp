#include "paths/feed/depth_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/map/nearest_pixel.h"

namespace dwell {
namespace {

void check(const ToolPath& path, const std::vector<double>& pitch, const DepthFeedJob& job) {
  validate(path);
  if (pitch.size() != path.size()) {
    throw InputError(fmt::format("depth feed: {} pitches for {}; required one each", pitch.size(),
                                 counted(path.size(), "dwell point")));
  }
  for (std::size_t j = 0; j < pitch.size(); ++j) {
    if (std::isfinite(pitch[j]) && pitch[j] > 0.0) continue;
    throw InputError(fmt::format("depth feed: pitch of point {} = {} mm; required finite and > 0", j + 1, pitch[j]));
  }
  if (!(std::isfinite(job.volume) && job.volume > 0.0)) {
    throw InputError(fmt::format("depth feed: volume = {} nm mm^2/s; required finite and > 0", job.volume));
  }
  if (!std::isfinite(job.lowest)) {
    throw InputError(fmt::format("depth feed: lowest = {} nm; required finite", job.lowest));
  }
  if (!(job.step > 0.0)) throw InputError(fmt::format("depth feed: step = {} mm; required > 0", job.step));
  if (!(job.max_feed > 0.0)) {
    throw InputError(fmt::format("depth feed: max_feed = {} mm/s; required > 0", job.max_feed));
  }
}

/// A map whose pixels all have the height of the nearest one with data.
HeightMap fill_from_nearest(const HeightMap& map, const Progress& progress) {
  const std::vector<Index> nearest = nearest_pixels(map, progress);
  HeightMap filled = map;
  for (std::size_t i = 0; i < nearest.size(); ++i) filled.values[i] = map.values[static_cast<std::size_t>(nearest[i])];
  return filled;
}

double bilinear(const HeightMap& map, Point p) {
  const Grid& g = map.grid;
  const auto split = [](double offset, Index count, double& share) {
    const double clamped = std::clamp(offset, 0.0, static_cast<double>(count - 1));
    const auto cell = std::min(static_cast<Index>(clamped), std::max<Index>(0, count - 2));
    share = clamped - static_cast<double>(cell);
    return cell;
  };
  double u = 0.0, v = 0.0;
  const Index col = split((p.x - g.origin.x) / g.pitch_x, g.cols, u);
  const Index row = split((p.y - g.origin.y) / g.pitch_y, g.rows, v);
  const Index right = std::min(col + 1, g.cols - 1), up = std::min(row + 1, g.rows - 1);
  return (1.0 - v) * ((1.0 - u) * map.at(row, col) + u * map.at(row, right)) +
         v * ((1.0 - u) * map.at(up, col) + u * map.at(up, right));
}

}  // namespace

DepthFeed depth_feed(const HeightMap& target, const ToolPath& path, const std::vector<double>& pitch,
                     const DepthFeedJob& job, const Progress& progress) {
  check(path, pitch, job);
  const HeightMap heights = fill_from_nearest(target, progress);
  const std::vector<Stroke> strokes = moving_strokes(path);
  DepthFeed feed;
  feed.speed.resize(strokes.size(), 0.0);
  feed.dwell = Eigen::VectorXd::Zero(static_cast<Index>(strokes.size()));
  Poll poll(progress);
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    poll.step();
    const double length = strokes[j].length();
    const double stands_for = std::isfinite(job.step) ? job.step : length;
    const double depth = std::max(0.0, bilinear(heights, path.points[j]) - job.lowest);
    const double wanted = depth * pitch[j] * stands_for / job.volume;
    const double least = length / job.max_feed;
    if (wanted < least) ++feed.limited;
    feed.dwell[static_cast<Index>(j)] = std::max(wanted, least);
    if (length > 0.0) feed.speed[j] = length / feed.dwell[static_cast<Index>(j)];  // infinite for no dwell
  }
  feed.total_seconds = feed.dwell.sum();
  return feed;
}

}  // namespace dwell
