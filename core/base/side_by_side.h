#pragma once

#include <cstddef>
#include <functional>

#include "core/base/progress.h"

namespace dwell {

/// One of two parts of a computation that do not depend on each other: its handle, and the threads that it may use.
using Side = std::function<void(const Progress& progress, int threads)>;

/// Runs both at once on half of the threads each; with one thread, or where the system gives no second one, one after
/// the other. The handle that they share is called by one of them at a time. Where one throws, the other is stopped
/// and what was thrown first is thrown again. What the sides do must not depend on the number of their threads.
void run_side_by_side(int threads, const Progress& progress, const Side& first, const Side& second);

/// Calls task(k, progress) for every k below count, in order on one thread and two at a time on more, in the same way.
void run_side_by_side(int threads, const Progress& progress, std::size_t count,
                      const std::function<void(std::size_t k, const Progress& progress)>& task);

}  // namespace dwell
