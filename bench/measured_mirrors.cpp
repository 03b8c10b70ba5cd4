#include "bench/measured_mirrors.h"

#include <limits>

#include "core/formats/map_io.h"
#include "paths/path_file.h"

namespace dwell::bench {
namespace {

HeightMap read(const std::filesystem::path& file, double pitch) {
  MapReadOptions options;
  options.pitch = square_pitch(pitch);
  return read_map(file, options);
}

/// A simulated mirror with noise: only what is farther than kMargin pixels from its edge counts, and the tool dwells on
/// the pixels from half as far on.
Parts ibfest(const std::filesystem::path& folder) {
  constexpr Index kMargin = 84;
  constexpr double kPitch = 0.120505;
  Parts p;
  p.map = read(folder / "map_nm.csv", kPitch);
  p.tif = gaussian_removal(1.0, 2.7752, 0.5 * kMargin * kPitch);
  const Index rows = p.map.grid.rows, cols = p.map.grid.cols, reach = kMargin / 2;
  for (Index r = reach; r < rows - reach; ++r) {
    for (Index c = reach; c < cols - reach; ++c)
      p.path.points.push_back(p.map.grid.centre(r, r % 2 ? cols - 1 - c : c));
  }
  p.path.lifted.assign(p.path.points.size(), 0);
  p.whole = p.map;
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < cols; ++c) {
      if (r < kMargin || r >= rows - kMargin || c < kMargin || c >= cols - kMargin)
        p.map.at(r, c) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return p;
}

/// A measured mirror with a measured spot and its raster.
Parts udo(const std::filesystem::path& folder) {
  constexpr double kPitch = 0.09383299999999997;
  Parts p;
  p.map = read(folder / "map_nm.csv", kPitch);
  p.tif = measured_removal(read(folder / "tif_nm_per_s.csv", 0.09383299766341224), {TifCentre::Kind::Middle, {}});
  p.path = read_path_file(folder / "path_and_published_dwell.csv");
  p.moving = true;
  p.least = 0.1;
  return p;
}

}  // namespace

void append_measured_mirrors(std::vector<Scenario>& all, const std::filesystem::path& data) {
  const auto append = [&](const std::string& folder, const std::string& what, bool lattice,
                          Parts (*make)(const std::filesystem::path&)) {
    const std::filesystem::path path = data / folder;
    if (!std::filesystem::is_regular_file(path / "map_nm.csv")) return;
    Scenario s;
    s.name = "e-" + folder;
    s.what = what;
    s.lattice = lattice;
    s.make = [=] { return make(path); };
    all.push_back(s);
  };
  append("ibfest-70x30", "simulated mirror with noise, 80 x 412 counted pixels, dwell at every pixel", true, ibfest);
  append("udo-raster", "measured mirror 168 x 985, measured spot, raster of 2,678 points, at least 0.1 s each", false,
         udo);
}

}  // namespace dwell::bench
