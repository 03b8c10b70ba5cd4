#pragma once

#include <optional>
#include <string>

namespace dwell::bench {

enum class Verdict { Met, Missed, NotMeasured };
std::string to_string(Verdict verdict);

/// NaN counts as missed; nothing counts as not measured.
Verdict at_most(const std::optional<double>& seen, double limit);
Verdict at_least(const std::optional<double>& seen, double limit);

/// Of two parts of one aim: missed if either is, else not measured if either is not.
Verdict worse(Verdict a, Verdict b);

/// One aim of the project and the value that a run has found.
struct TargetLine {
  std::string what, target, seen;
  Verdict verdict = Verdict::NotMeasured;
};

}  // namespace dwell::bench
