#include "runs/example/example_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "core/form/map_statistics.h"
#include "core/formats/map_io.h"
#include "core/tif/removal_function.h"
#include "runs/base/json_blocks.h"
#include "runs/job/job_file.h"

namespace dwell {
namespace {

HeightMap round_heights(HeightMap map) {
  for (double& v : map.values) v = std::round(v * 1e4) / 1e4;
  return map;
}

}  // namespace

const ResultFiles& example_files() {
  static const ResultFiles kFiles{"example", "MANIFEST", {"mirror.csv", "tif.csv", "demo.toml"}, {}, nullptr};
  return kFiles;
}

Example write_example(const std::filesystem::path& folder, const ExampleOptions& mirror, const ExampleTifOptions& tif,
                      const Progress& progress) {
  Example example{round_heights(example_mirror(mirror, progress)), round_heights(example_tif(tif))};
  progress.step("writing mirror.csv");
  write_map(folder / "mirror.csv", example.mirror);
  progress.check();
  write_map(folder / "tif.csv", example.tif);

  JobOptions job;
  job.map = "mirror.csv";
  job.tif = "tif.csv";
  job.tif_centre = TifCentre{TifCentre::Kind::Centroid, {}};
  job.path = parse_path_spec("raster:pitch=1");
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
  return example;
}

std::string example_json(const Example& example, std::uint64_t seed) {
  const FormTerms terms = JobOptions{}.remove;
  const RemovalFunction tif = measured_removal(example.tif, {TifCentre::Kind::Centroid, {}});
  nlohmann::ordered_json json = json_of_command("example");
  json["map"] = map_block({"mirror.csv", example.mirror.grid, example.mirror.history, example.mirror.valid_pixels(),
                           "map", to_string(terms), map_statistics(example.mirror, terms)});
  json["tif"] = tif_block(tif, kind_of(tif), tif.samples.history);
  json["seed"] = seed;
  json["files"] = {"mirror.csv", "tif.csv", "demo.toml", "MANIFEST"};
  return json_text(std::move(json));
}

}  // namespace dwell
