#include "bench/verdict.h"

namespace dwell::bench {

Verdict worse(Verdict a, Verdict b) {
  for (const Verdict v : {Verdict::Missed, Verdict::NotMeasured}) {
    if (a == v || b == v) return v;
  }
  return Verdict::Met;
}

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::Met:
      return "met";
    case Verdict::Missed:
      return "missed";
    case Verdict::NotMeasured:
      return "not measured";
  }
  return "not measured";
}

Verdict at_most(const std::optional<double>& seen, double limit) {
  if (!seen) return Verdict::NotMeasured;
  return *seen <= limit ? Verdict::Met : Verdict::Missed;
}

Verdict at_least(const std::optional<double>& seen, double limit) {
  if (!seen) return Verdict::NotMeasured;
  return *seen >= limit ? Verdict::Met : Verdict::Missed;
}

}  // namespace dwell::bench
