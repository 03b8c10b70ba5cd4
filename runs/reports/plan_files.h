#pragma once

#include "runs/base/output_folder.h"

namespace dwell {

/// The files of a plan's folder: its program in every format of runs/programs/program_formats.h, pictures, arrays and
/// the summary.
const ResultFiles& plan_files();

}  // namespace dwell
