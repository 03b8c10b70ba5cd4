#include "runs/reports/another_surface.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "runs/job/line_profile_map.h"

namespace dwell {
namespace {

/// One weight a pixel of the whole surface, as make_part takes them: 0 where a pixel does not count.
std::vector<double> weights_of_all(const Part& part) {
  std::vector<double> weights = part.weights;
  if (part.beside.values.empty()) return weights;
  if (weights.empty()) weights.assign(part.map.values.size(), 1.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!std::isfinite(part.map.values[i])) weights[i] = 0.0;
  }
  return weights;
}

void forget_surface(JobOptions& options, const FormTerms& form) {
  const JobOptions none;
  forget_line_profile(options);
  forget_map(options);
  options.map_steps = none.map_steps;
  options.aperture = none.aperture;
  options.removal = none.removal;
  options.piston_nm = none.piston_nm;
  options.remove = form;
  options.remove_given = true;
}

/// The files of the job, with the surface in the place of the map and of what its steps read.
std::vector<InputFile> inputs_with(const std::vector<InputFile>& inputs, const InputFile& map) {
  std::vector<InputFile> rest;
  bool before = true, of_map = false;
  for (const InputFile& input : inputs) {
    if (before && (input.role == "map" || input.role == "profile" || input.role == "removal")) {
      before = false, of_map = true;
      rest.push_back(map);
    }
    if (input.role == "tif" || input.role == "weight") of_map = false;
    if (!of_map) rest.push_back(input);
  }
  return rest;
}

}  // namespace

HeightMap whole_surface(const Part& part) {
  HeightMap whole = part.map;
  if (part.beside.values.empty()) return whole;
  for (std::size_t i = 0; i < whole.values.size(); ++i) {
    if (!std::isfinite(whole.values[i])) whole.values[i] = part.beside.values[i];
  }
  return whole;
}

void replace_surface(Job& job, const HeightMap& surface, const OutputFolder& folder, const std::string& name,
                     const Progress& progress) {
  const Part& part = *job.part;
  std::vector<double> weights = weights_of_all(part);
  job.part =
      std::make_shared<const Part>(make_part(surface, part.tif, part.form, part.threads, progress, std::move(weights)));
  forget_surface(job.options, job.part->form);
  job.options.map = (std::filesystem::path(job.options.out) / name).string();
  write_map(folder.path(name), surface);
  job.inputs = inputs_with(job.inputs, {"map", job.options.map, sha256_of_file(folder.path(name))});
}

}  // namespace dwell
