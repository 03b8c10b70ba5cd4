#pragma once

#include <string>

#include "runs/base/output_folder.h"
#include "runs/base/sweep_part.h"

namespace dwell {

/// The files of a part of a sweep: part.json, and in parts of a comparison of paths a folder for each plan.
const ResultFiles& part_files();

/// Throws InputError if the folder holds the part of another shard, which this one would replace.
void refuse_part_of_another_shard(const std::string& folder, const Shard& shard);

}  // namespace dwell
