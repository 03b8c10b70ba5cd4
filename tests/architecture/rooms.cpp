#include "tests/architecture/rooms.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "tests/architecture/source_file.h"

namespace dwell::architecture {
namespace {

using RoomRanks = std::map<std::string, int>;

const std::map<std::string, RoomRanks>& room_ranks() {
  static const std::map<std::string, RoomRanks> kRanks{
      {"core",
       {{"base", 0},
        {"numerics", 1},
        {"motion", 1},
        {"map", 2},
        {"profile", 2},
        {"formats", 3},
        {"form", 3},
        {"spectra", 3},
        {"anatomy", 4},
        {"tif", 4},
        {"tif/models", 5},
        {"tif/calibration", 5},
        {"removal", 5}}},
      {"paths",
       {{"domain", 0}, {"feed", 0}, {"lines", 1}, {"lattice", 1}, {"tours", 1}, {"metrics", 1}, {"curves", 2}}},
      {"solvers", {{"problem", 0}, {"fits", 0}, {"weights", 0}, {"native", 1}, {"peers", 1}, {"matched", 2}}},
      // Plans are made from values and know no job.
      {"runs",
       {{"base", 0},
        {"drawing", 0},
        {"programs", 0},
        {"machine", 0},
        {"acceptance", 0},
        {"logs", 1},
        {"plan", 1},
        {"map_steps", 1},
        {"profile", 1},
        {"tools", 2},
        {"job", 2},
        {"reports", 3},
        {"example", 3},
        {"campaigns", 4},
        {"figure", 5},
        {"figure/store", 6}}}};
  return kRanks;
}

struct Library {
  const char* name;
  std::vector<std::string> headers;  // how the names of its headers begin
  std::vector<std::string> users;    // how the paths of the files begin that may include them
};

const std::vector<Library>& libraries() {
  static const std::vector<Library> kLibraries{
      {"Ceres", {"ceres/"}, {"solvers/fits/", "solvers/peers/"}},
      {"NLopt", {"nlopt"}, {"solvers/weights/", "solvers/peers/"}},
      {"L-BFGS-B", {"lbfgsb", "LBFGS"}, {"solvers/peers/"}},
      {"FFTW", {"fftw3"}, {"core/numerics/", "bench/"}},
      {"HDF5", {"hdf5", "H5"}, {"core/formats/hdf5_"}},
      {"CFITSIO", {"fitsio"}, {"core/formats/fits_"}},
      {"OpenSSL", {"openssl/"}, {"core/base/"}},
      {"toml++", {"toml"}, {"runs/job/", "runs/machine/", "runs/programs/program_template.cpp"}},
      {"nlohmann", {"nlohmann/"}, {"core/formats/", "runs/", "cli/", "bench/"}},
      {"CLI11", {"CLI/"}, {"cli/", "bench/"}},
      {"libpng", {"png.h"}, {"runs/drawing/"}},
      {"Cairo", {"cairo"}, {"runs/drawing/"}},
      {"Google Benchmark", {"benchmark/"}, {"bench/"}},
      {"OpenMP's functions", {"omp.h"}, {"core/base/threads", "solvers/peers/ceres_solver", "bench/solve_run"}}};
  return kLibraries;
}

bool begins_with_any(const std::string& text, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&](const auto& b) { return text.starts_with(b); });
}

}  // namespace

std::optional<std::string> room_fault(const std::string& path, const std::string& target) {
  const std::string top = top_folder(path), from = room(path), to = room(target);
  const auto rooms = room_ranks().find(top);
  if (rooms == room_ranks().end() || top_folder(target) != top || from.empty()) return std::nullopt;
  if (to.empty()) return fmt::format("\"{}\" is a door of {}; no room of {} may include it", target, top, top);
  const RoomRanks& ranks = rooms->second;
  for (const std::string& name : {from, to}) {
    if (!ranks.contains(name)) return fmt::format("{}/{} has no rank; give it one in rooms.cpp", top, name);
  }
  if (from == to || ranks.at(to) < ranks.at(from)) return std::nullopt;
  return fmt::format("{}/{} (rank {}) may not include {}/{} (rank {}): \"{}\"", top, from, ranks.at(from), top, to,
                     ranks.at(to), target);
}

std::optional<std::string> third_party_fault(const std::string& path, const std::string& target) {
  for (const Library& library : libraries()) {
    if (!begins_with_any(target, library.headers) || begins_with_any(path, library.users)) continue;
    return fmt::format("only {} may include {}: <{}>", fmt::join(library.users, ", "), library.name, target);
  }
  return std::nullopt;
}

}  // namespace dwell::architecture
