#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_file.h"

namespace dwell::architecture {

/// Which concept includes which. A concept is a header with its sources: a_b.cpp belongs to a_b.h or, without one, to
/// a.h. It is named by its path without an ending.
using ConceptGraph = std::map<std::string, std::set<std::string>>;

ConceptGraph concept_graph(const std::vector<SourceFile>& files);

std::size_t arrows(const ConceptGraph& graph);

/// The groups of two and more concepts each of which needs all the others of its group, each group sorted.
std::vector<std::vector<std::string>> circles(const ConceptGraph& graph);

/// A violation for every circle.
std::vector<Violation> check_circles(const std::vector<SourceFile>& files);

}  // namespace dwell::architecture
