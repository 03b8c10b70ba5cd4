#include "core/base/time_limit.h"

#include <fmt/format.h>

#include <utility>

namespace dwell {

TimeLimit::TimeLimit(double seconds, std::string name, double used)
    : seconds_(seconds), used_(used), name_(std::move(name)) {}

double TimeLimit::used() const {
  return used_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

double TimeLimit::left() const { return seconds_ - used(); }

std::string TimeLimit::message(const std::string& news) const {
  return fmt::format("`{}` of {} s was over before the solve, at \"{}\"; nothing was written", name_, seconds_, news);
}

}  // namespace dwell
