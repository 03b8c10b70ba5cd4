#pragma once

namespace dwell {

/// How often memory has been asked for in this program: malloc, which operator new and Eigen stand on. -1 where it
/// cannot be counted (under a sanitizer, which has a malloc of its own).
long allocation_count();

}  // namespace dwell
