#pragma once

#include <string>

#include "runs/reports/tif_run.h"

namespace dwell {

/// What `dwell tif` prints: a few lines with units.
std::string tif_text(const TifResult& result);

/// The same figures and more as JSON (docs/json.md).
std::string tif_json(const TifResult& result);

}  // namespace dwell
