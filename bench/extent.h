#pragma once

#include <string>

namespace dwell::bench {

/// How much a run of the harness measures.
enum class Extent {
  Quick,    // small sizes and short repetitions, in 2 minutes: that nothing is broken
  Default,  // everything that finds time in 15 minutes
  Full,     // everything, as long as it takes: what docs/benchmarks.md is made of
};

inline std::string to_string(Extent extent) {
  return extent == Extent::Quick ? "quick" : extent == Extent::Default ? "default" : "full";
}

}  // namespace dwell::bench
