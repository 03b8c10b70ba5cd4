#include "bench/made_up_mirrors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/mirror.h"
#include "runs/example/example.h"

namespace dwell::bench {
namespace {

constexpr double kMirrorPitch = 0.1;  // [mm]
constexpr double kMirrorRms = 100.0;  // of a made-up mirror [nm]
constexpr double kFwhmPerSigma = 2.3548200450309493;
constexpr double kOverrun = 2.0;  // how far dwell points lie beyond the part [sigma]

double sigma_of(Index n) { return static_cast<double>(n) / 50.0 * kMirrorPitch; }

RemovalFunction gaussian(Index n) { return gaussian_removal(1.0, kFwhmPerSigma * sigma_of(n), 3.5 * sigma_of(n)); }

/// Every `step`-th pixel of the map and `overrun` beyond it, line by line, to and fro; only points that `keep` wants.
ToolPath lattice_path(const Grid& grid, Index step, double overrun, const std::function<bool(Point)>& keep) {
  ToolPath path;
  path.kind = "raster";
  const Index beyond = static_cast<Index>(std::ceil(overrun / grid.pitch_x / static_cast<double>(step))) * step;
  bool forth = true;
  for (Index r = -beyond; r < grid.rows + beyond; r += step, forth = !forth) {
    std::vector<Point> line;
    for (Index c = -beyond; c < grid.cols + beyond; c += step) {
      if (keep(grid.centre(r, c))) line.push_back(grid.centre(r, c));
    }
    if (!forth) std::reverse(line.begin(), line.end());
    path.points.insert(path.points.end(), line.begin(), line.end());
  }
  path.lifted.assign(path.points.size(), 0);
  return path;
}

Parts square_mirror(Index n, Index step) {
  Parts p;
  p.map = noise_mirror(n, kMirrorPitch, kMirrorRms, 1);
  p.tif = gaussian(n);
  p.path = lattice_path(p.map.grid, step, kOverrun * sigma_of(n), [](Point) { return true; });
  return p;
}

Parts ring_mirror(Index n, Index step) {
  Parts p;
  p.map = noise_mirror(n, kMirrorPitch, kMirrorRms, 2);
  const double outer = 0.5 * kMirrorPitch * static_cast<double>(n), inner = 0.25 * outer;
  cut_ring(p.map, inner, outer);
  p.tif = gaussian(n);
  const double beyond = kOverrun * sigma_of(n);
  p.path = lattice_path(p.map.grid, step, beyond,
                        [=](Point q) { return length(q) >= inner - beyond && length(q) <= outer + beyond; });
  return p;
}

/// Archimedean spiral about (0, 0): as far between its turns as between its points, out to `radius`.
ToolPath spiral_path(Index points, double radius) {
  const double pitch = radius * std::sqrt(std::numbers::pi / static_cast<double>(points));
  const double growth = pitch / (2.0 * std::numbers::pi);  // r = growth * angle
  ToolPath path;
  path.kind = "spiral";
  double angle = std::sqrt(2.0 * pitch / growth);
  for (Index k = 0; k < points; ++k) {
    const double r = growth * angle;
    path.points.push_back({r * std::cos(angle), r * std::sin(angle)});
    angle += pitch / std::hypot(r, growth);
  }
  path.lifted.assign(path.points.size(), 0);
  return path;
}

Parts spiral_mirror(Index n, Index points) {
  Parts p;
  p.map = noise_mirror(n, kMirrorPitch, kMirrorRms, 3);
  const double outer = 0.5 * kMirrorPitch * static_cast<double>(n);
  cut_ring(p.map, 0.0, outer);
  p.tif = gaussian(n);
  p.path = spiral_path(points, outer + kOverrun * sigma_of(n));
  p.moving = true;
  return p;
}

/// The spot of the example, skewed and off its middle, on its own pitch.
Parts measured_spot(Index n, Index step) {
  Parts p;
  p.map = noise_mirror(n, kMirrorPitch, kMirrorRms, 4);
  ExampleTifOptions spot;
  spot.fwhm = kFwhmPerSigma * sigma_of(n);
  spot.pitch = spot.fwhm / 24.0;
  spot.half_width = 1.4 * spot.fwhm;
  spot.offset_x = 0.03 * spot.fwhm;
  spot.offset_y = -0.025 * spot.fwhm;
  p.tif = measured_removal(example_tif(spot), {TifCentre::Kind::Middle, {}});
  p.path = lattice_path(p.map.grid, step, kOverrun * sigma_of(n), [](Point) { return true; });
  return p;
}

}  // namespace

void append_made_up_mirrors(std::vector<Scenario>& all) {
  for (const Index n : {64, 256, 1024, 2048, 4096}) {
    for (const Index step : {4, 1}) {
      if ((n > 1024 || n == 64) && step == 1) continue;
      Scenario s;
      s.name = fmt::format("a-{}-every-{}", n, step);
      s.what = fmt::format("square mirror {} x {}, dwell at every {}pixel", n, n, step == 1 ? "" : "4th ");
      s.quick = n <= 256 && step == 4;
      s.lattice = true;
      s.make = [=] { return square_mirror(n, step); };
      all.push_back(s);
    }
  }
  Scenario ring;
  ring.name = "b-512";
  ring.what = "round mirror 512 x 512 with a central hole, dwell at every 4th pixel";
  ring.lattice = true;
  ring.make = [] { return ring_mirror(512, 4); };
  all.push_back(ring);
  for (const Index points : {3'000, 30'000, 1'000'000}) {
    Scenario s;
    s.name = fmt::format("c-{}", points);
    s.what = fmt::format("round mirror 512 x 512, spiral of {} points", points);
    s.quick = points == 3'000;
    s.make = [=] { return spiral_mirror(512, points); };
    all.push_back(s);
  }
  Scenario spot;
  spot.name = "d-512";
  spot.what = "square mirror 512 x 512, measured spot without symmetry, dwell at every 4th pixel";
  spot.lattice = true;
  spot.make = [] { return measured_spot(512, 4); };
  all.push_back(spot);
}

}  // namespace dwell::bench
