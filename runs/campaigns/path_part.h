#pragma once

#include "runs/base/merged_parts.h"
#include "runs/base/output_folder.h"
#include "runs/base/sweep_part.h"
#include "runs/campaigns/path_comparison.h"

namespace dwell {

/// The command whose parts these are.
inline constexpr const char* kPathsCommand = "paths";

/// What a shard of a comparison has come to; `folder` holds the plans of its paths, whose files are recorded with their
/// SHA-256.
SweepPart path_part(const PathComparison& comparison, const Shard& shard, const OutputFolder& folder);

/// The whole comparison, put together from its parts: concluded, and with each plan copied from the part's folder into
/// one of its name within `folder`, which will be at `out`. The way from a plan to the names of its inputs
/// (summary.json, "names_from") is made anew. Throws InputError for a file that is another than its part says, and as
/// conclude.
PathComparison merged_paths(const MergedParts& parts, const OutputFolder& folder, const std::filesystem::path& out,
                            const Progress& progress = {});

}  // namespace dwell
