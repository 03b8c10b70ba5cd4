#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace dwell::bench {

/// The wall clock of a whole run of the harness, started when it is made. Every part of the harness asks how much of it
/// is left.
class Budget {
 public:
  explicit Budget(double seconds) : total_(seconds) {}
  static Budget without_end() { return Budget(std::numeric_limits<double>::infinity()); }

  bool endless() const { return std::isinf(total_); }
  double total() const { return total_; }
  double spent() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  /// Until `share` of the whole is spent; not below 0 [s].
  double left(double share = 1.0) const { return std::max(0.0, share * total_ - spent()); }

 private:
  double total_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace dwell::bench
