#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_file.h"

namespace dwell::architecture {

/// The headers that cmake/public_headers.txt names, sorted: a line is a header, or "core/map/*" for all headers
/// directly in a folder; lines that begin with # say why.
std::vector<std::string> public_headers(const std::string& list, const std::vector<SourceFile>& files);

/// A violation for every line of the list that names no header, and for every public header that includes one that is
/// not: it would be missing where the library is installed.
std::vector<Violation> check_public_face(const std::string& list, const std::vector<SourceFile>& files);

}  // namespace dwell::architecture
