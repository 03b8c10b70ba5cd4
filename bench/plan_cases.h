#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/extent.h"

namespace dwell::bench {

struct PlanRunOptions {
  Extent extent = Extent::Default;  // Quick: maps of 1024^2 pixels; Full: one of 16384^2 besides
  long size = 0;                    // edge of the large maps [pixels]; 0 = by the extent
  std::filesystem::path data;       // public mirrors
};

/// One call of the program that is timed.
struct PlanCase {
  std::string name, what;
  long size = 0;          // edge of the map [pixels]; 0 = not a made-up one
  double enlarged = 1.0;  // of the map's edge, each pixel of a smaller made-up one so many times along x and y
  std::vector<std::string> arguments;  // of `dwell`
  int threads = 2;
  bool one_processor = false;
  double longest = 60.0;         // [s]
  double interrupt_after = 0.0;  // SIGINT then; 0 = never [s]
  bool simulates = false;        // `dwell simulate --json` in place of a plan
};

/// The cases of a run, their files in `folder`.
std::vector<PlanCase> plan_cases(const PlanRunOptions& options, const std::filesystem::path& folder);

/// The map of a case, as its arguments name it.
std::filesystem::path map_of(const PlanCase& plan, const std::filesystem::path& folder);

/// Writes the published dwell of udo-raster as a feed table for `dwell simulate`.
void write_published_programs(const std::filesystem::path& udo, const std::filesystem::path& folder);

}  // namespace dwell::bench
