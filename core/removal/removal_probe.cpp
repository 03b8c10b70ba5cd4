#include "core/removal/removal_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/tif/pixel_mean.h"

namespace dwell {
namespace {

/// The two points of Gauss and Legendre, from the middle of a panel in half panels.
constexpr double kGaussPoint = 0.57735026918962576451;

/// RMS of the kernel's difference from the mean over pixels, relative to the latter's, at places spread over it.
double table_error(const RemovalKernel& kernel, const std::function<double(Point)>& mean) {
  constexpr int kPlaces = 1024;
  constexpr double kAlongX = 0.754877666246693, kAlongY = 0.569840290998053;  // Roberts' R2 sequence
  const Grid& g = kernel.surface.grid();
  double error = 0.0, norm = 0.0;
  for (int k = 1; k <= kPlaces; ++k) {
    const double u = std::fmod(k * kAlongX, 1.0), v = std::fmod(k * kAlongY, 1.0);
    const Point p = g.origin + Point{u * (g.width() - g.pitch_x), v * (g.height() - g.pitch_y)};
    const double b = mean(p), e = kernel.rate(p) - b;
    error += e * e;
    norm += b * b;
  }
  return norm > 0.0 ? std::sqrt(error / norm) : 0.0;
}

}  // namespace

PixelMeanTable tabulate_pixel_mean(const RemovalFunction& tif, const Grid& map) {
  constexpr double kPanelError = 3e-4, kShortestPanel = 0.1;  // of a pixel
  const double hx = map.pitch_x, hy = map.pitch_y;
  const auto mean = mean_rate_over_pixel(tif, hx, hy);
  PixelMeanTable table;
  table.point = rate_at_point(tif);
  for (Index division = 1;; division *= 2) {
    const RemovalKernel kernel = pixel_kernel(tif, hx, hy, {division, division});
    const double error = table_error(kernel, mean);
    if (table.panel == 0.0 && error <= kPanelError)
      table.panel = 2.0 * std::min(hx, hy) / static_cast<double>(division);
    const bool largest = 4.0 * static_cast<double>(kernel.surface.grid().size()) > PixelMeanTable::kMostNodes;
    if (error > PixelMeanTable::kError && !largest) continue;
    table.mean = kernel.surface;
    break;
  }
  if (table.panel == 0.0) table.panel = kShortestPanel * std::min(hx, hy);
  return table;
}

RemovalProbe::RemovalProbe(const Grid& map, const PixelMeanTable& table, const std::vector<Stroke>& strokes,
                           std::span<const double> seconds)
    : map_(map), table_(table) {
  if (seconds.size() != strokes.size()) throw std::invalid_argument("RemovalProbe: one time a stroke is required");
  const Grid& g = table.mean.grid();
  // The two outermost nodes of either side are zeros; so near to them rounding leads to no node beyond.
  low_ = g.centre(2, 2);
  high_ = g.centre(g.rows - 3, g.cols - 3);
  std::vector<Visit> visits;
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    const Stroke& s = strokes[j];
    if (!(seconds[j] > 0.0)) continue;
    const double total = s.length();
    if (!(total > 0.0)) {
      add_visit(s.via, seconds[j], visits);
      continue;
    }
    const Point chord = s.finish - s.start;
    const bool straight = length(chord) >= total * (1.0 - 1e-12);
    if (straight) {
      add_leg(s.start, s.finish, seconds[j], visits);
    } else {
      add_leg(s.start, s.via, seconds[j] * distance(s.start, s.via) / total, visits);
      add_leg(s.via, s.finish, seconds[j] * distance(s.via, s.finish) / total, visits);
    }
  }
  sort_into_cells(visits);
}

/// Only what reaches a pixel counts.
void RemovalProbe::add_visit(Point p, double seconds, std::vector<Visit>& visits) const {
  // A pixel further for the neighbours of the map's pixels, from which the ripple is taken.
  const Point low = map_.centre(0, 0) - high_ - Point{2.0 * map_.pitch_x, 2.0 * map_.pitch_y};
  const Point high = map_.centre(map_.rows - 1, map_.cols - 1) - low_ + Point{2.0 * map_.pitch_x, 2.0 * map_.pitch_y};
  if (p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y) visits.push_back({p, seconds});
}

void RemovalProbe::add_leg(Point from, Point to, double seconds, std::vector<Visit>& visits) const {
  // What lies far beyond the map is one panel, however long.
  const double total = distance(from, to);
  const double panels = std::max(1.0, std::ceil(total / table_.panel));
  const Point half = (0.5 / panels) * (to - from);
  for (double k = 0.0; k < panels; k += 1.0) {
    const Point middle = from + (2.0 * k + 1.0) * half;
    add_visit(middle - kGaussPoint * half, 0.5 * seconds / panels, visits);
    add_visit(middle + kGaussPoint * half, 0.5 * seconds / panels, visits);
  }
}

void RemovalProbe::sort_into_cells(const std::vector<Visit>& visits) {
  if (visits.empty()) {
    cells_ = {1, 1, 1.0, 1.0, {}};
    begin_.assign(2, 0);
    return;
  }
  Point least = visits.front().position, most = least;
  for (const Visit& v : visits) {
    least = {std::min(least.x, v.position.x), std::min(least.y, v.position.y)};
    most = {std::max(most.x, v.position.x), std::max(most.y, v.position.y)};
  }
  constexpr double kCellsUnderTool = 6.0, kMostCells = 2048.0;  // along an axis
  const auto cell = [&](double reach, double extent) { return std::max(reach / kCellsUnderTool, extent / kMostCells); };
  cells_.pitch_x = std::max(cell(high_.x - low_.x, most.x - least.x), 1e-12);
  cells_.pitch_y = std::max(cell(high_.y - low_.y, most.y - least.y), 1e-12);
  cells_.origin = least;
  cells_.cols = static_cast<Index>((most.x - least.x) / cells_.pitch_x) + 1;
  cells_.rows = static_cast<Index>((most.y - least.y) / cells_.pitch_y) + 1;
  const auto cell_of = [&](const Visit& v) {
    const Index row = std::min(cells_.rows - 1, static_cast<Index>((v.position.y - least.y) / cells_.pitch_y));
    const Index col = std::min(cells_.cols - 1, static_cast<Index>((v.position.x - least.x) / cells_.pitch_x));
    return static_cast<std::size_t>(cells_.index(row, col));
  };
  begin_.assign(static_cast<std::size_t>(cells_.size()) + 1, 0);
  for (const Visit& v : visits) ++begin_[cell_of(v) + 1];
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  visits_.resize(visits.size());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (const Visit& v : visits) visits_[next[cell_of(v)]++] = v;
}

template <class Take>
void RemovalProbe::for_visits(Point centre, const Take& take) const {
  const auto bounded = [](double k, Index count) {
    return static_cast<Index>(std::clamp(std::floor(k), 0.0, static_cast<double>(count - 1)));
  };
  // The tool at p acts at centre - p.
  const Index row_0 = bounded((centre.y - high_.y - cells_.origin.y) / cells_.pitch_y, cells_.rows),
              row_1 = bounded((centre.y - low_.y - cells_.origin.y) / cells_.pitch_y, cells_.rows),
              col_0 = bounded((centre.x - high_.x - cells_.origin.x) / cells_.pitch_x, cells_.cols),
              col_1 = bounded((centre.x - low_.x - cells_.origin.x) / cells_.pitch_x, cells_.cols);
  for (Index row = row_0; row <= row_1; ++row) {
    const std::size_t end = begin_[static_cast<std::size_t>(cells_.index(row, col_1)) + 1];
    for (std::size_t k = begin_[static_cast<std::size_t>(cells_.index(row, col_0))]; k < end; ++k) {
      const Visit& v = visits_[k];
      const Point d = centre - v.position;
      if (d.x > low_.x && d.x < high_.x && d.y > low_.y && d.y < high_.y) take(d, v.seconds);
    }
  }
}

double RemovalProbe::mean_over_pixel(Point centre) const {
  double sum = 0.0;
  for_visits(centre, [&](Point d, double seconds) { sum += seconds * table_.mean.value_inside(d); });
  return sum;
}

double RemovalProbe::at(Point point) const {
  double sum = 0.0;
  for_visits(point, [&](Point d, double seconds) { sum += seconds * table_.point(d); });
  return sum;
}

double RemovalProbe::points_under_tool() const {
  const double area = (cells_.width()) * (cells_.height());
  return static_cast<double>(visits_.size()) * std::min(1.0, (high_.x - low_.x) * (high_.y - low_.y) / area);
}

Vector mean_removal(const RemovalProbe& probe, const Grid& map, const std::vector<Index>& pixels, int threads,
                    const Progress& progress) {
  constexpr double kRun = 2e7;  // Gauss points between two questions: a fifth of a second
  Vector removal(static_cast<Index>(pixels.size()));
  const auto run = static_cast<std::size_t>(std::clamp(kRun / std::max(1.0, probe.points_under_tool()), 1.0, 1e6));
  for (std::size_t first = 0; first < pixels.size(); first += run) {
    progress.step(fmt::format("{:.0f} %", 100.0 * static_cast<double>(first) / static_cast<double>(pixels.size())));
    const auto last = static_cast<Index>(std::min(pixels.size(), first + run));
#pragma omp parallel for num_threads(threads) schedule(dynamic, 4)
    for (auto i = static_cast<Index>(first); i < last; ++i)
      removal[i] = probe.mean_over_pixel(map.centre(pixels[static_cast<std::size_t>(i)]));
  }
  return removal;
}

}  // namespace dwell
