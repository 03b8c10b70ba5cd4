#pragma once

#include <string>

#include "runs/base/output_folder.h"

namespace dwell::cli {

/// The folder of --out for a result of a kind. Throws InputError as OutputFolder does, and if it lies in an earlier
/// result of any kind (refuse_inside_result).
OutputFolder result_folder(const std::string& out, const ResultFiles& files);

}  // namespace dwell::cli
