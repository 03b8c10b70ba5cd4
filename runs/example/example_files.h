#pragma once

#include <filesystem>

#include "runs/example/example.h"

namespace dwell {

/// Writes an example job into `folder` (made if it is not there): mirror.csv, tif.csv, demo.toml and a MANIFEST that
/// says what made them. Values are rounded to 1e-4 nm, so that the files do not depend on the mathematical library.
/// Throws InputError if the folder cannot be written.
void write_example(const std::filesystem::path& folder, const ExampleOptions& mirror, const ExampleTifOptions& tif);

}  // namespace dwell
