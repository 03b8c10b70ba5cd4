#pragma once

#include <string>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "runs/base/output_folder.h"
#include "runs/job/job.h"

namespace dwell {

/// The surface that the plan for one tool of several begins with, in its folder.
inline constexpr const char* kToolSurface = "surface.npy";
inline constexpr const char* kToolSurfaceSidecar = "surface.npy.json";

/// All pixels of a part with data, with those that do not count [nm].
HeightMap whole_surface(const Part& part);

/// Gives a loaded job another surface in the place of its map [nm], on the same grid and of the same pixels: writes it
/// into `folder`, in the file `name` of the plan that will lie at options.out, and makes part, options and inputs those
/// of a job that has read it there. What its own options have done to the map (steps, aperture, piston) is done; the
/// weights of pixels and the form terms stay. So the plan is self-contained. Throws InputError, Interrupted.
void replace_surface(Job& job, const HeightMap& surface, const OutputFolder& folder, const std::string& name,
                     const Progress& progress);

}  // namespace dwell
