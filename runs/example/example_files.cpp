#include "runs/example/example_files.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "runs/job/job_file.h"

namespace dwell {
namespace {

HeightMap rounded(HeightMap map) {
  for (double& v : map.values) v = std::round(v * 1e4) / 1e4;
  return map;
}

}  // namespace

void write_example(const std::filesystem::path& folder, const ExampleOptions& mirror, const ExampleTifOptions& tif) {
  const HeightMap map = rounded(example_mirror(mirror)), spot = rounded(example_tif(tif));
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(fmt::format("--out: cannot make the folder '{}': {}", folder.string(), error.message()));
  write_map(folder / "mirror.csv", map);
  write_map(folder / "tif.csv", spot);

  JobOptions job;
  job.map = "mirror.csv";
  job.tif = "tif.csv";
  job.tif_centre = TifCentre{TifCentre::Kind::Centroid, {}};
  job.path = "raster:pitch=1";
  job.max_feed_mm_per_min = 3000.0;
  write_whole_file(folder / "demo.toml", job_file_text(job));
  write_whole_file(
      folder / "MANIFEST",
      fmt::format(
          "Made by: dwell example (version {})\n"
          "mirror.csv  made-up mirror, seed {}, heights in nm, {} mm diameter or width, pixel pitch {} mm in x and y\n"
          "tif.csv     made-up removal function, seed {}, rates in nm/s, pixel pitch {} mm in x and y\n"
          "demo.toml   the job that plans it: dwell plan --job demo.toml --out FOLDER\n"
          "Row 0 = smallest y; nan = outside the part. No measured data.\n",
          version(), mirror.seed, mirror.width, mirror.pitch, tif.seed, tif.pitch));
}

}  // namespace dwell
