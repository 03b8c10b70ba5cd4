#pragma once

#include <filesystem>
#include <string>

#include "runs/base/output_folder.h"
#include "runs/example/example.h"

namespace dwell {

/// The files of an example, by which an earlier example is recognised.
const ResultFiles& example_files();

/// What was made.
struct Example {
  HeightMap mirror;  // as written [nm]
  HeightMap tif;     // [nm/s]
};

/// Writes an example job into `folder` (made if it is not there): mirror.csv, tif.csv, demo.toml and a MANIFEST that
/// says what made them. Values are rounded to 1e-4 nm, so that the files do not depend on the mathematical library.
/// Throws InputError if the folder cannot be written, Interrupted.
Example write_example(const std::filesystem::path& folder, const ExampleOptions& mirror, const ExampleTifOptions& tif,
                      const Progress& progress = {});

/// The example as JSON text (docs/json.md), units in the keys. `seed` is that of the mirror.
std::string example_json(const Example& example, std::uint64_t seed);

}  // namespace dwell
