#include "core/base/time_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dwell {

TimeLimit::TimeLimit(double stated, std::string name, double used, double least)
    : stated_(stated), seconds_(std::max(stated, least)), used_(used), name_(std::move(name)) {}

double TimeLimit::used() const {
  return used_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

double TimeLimit::left() const { return seconds_ - used(); }

std::string TimeLimit::message(const std::string& news) const {
  const std::string least =
      seconds_ > stated_ ? fmt::format(" (what comes before a solve has {} s in any case)", seconds_) : "";
  return fmt::format("`{}` of {} s{} was over before the solve, at \"{}\"", name_, stated_, least, news);
}

}  // namespace dwell
