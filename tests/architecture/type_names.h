#pragma once

#include <vector>

#include "tests/architecture/source_file.h"

namespace dwell::architecture {

/// A violation for every class, struct or enumeration that a header defines at namespace scope under a name that an
/// earlier header has already given to another: whoever includes both could not say which is meant.
std::vector<Violation> check_type_names(const std::vector<SourceFile>& files);

}  // namespace dwell::architecture
