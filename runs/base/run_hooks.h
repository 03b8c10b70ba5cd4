#pragma once

#include <functional>
#include <string>

#include "core/base/errors.h"

namespace dwell {

/// How a long run talks to whoever started it. Both may be empty.
struct RunHooks {
  /// One line of progress, with units; called at every stage and at every solver iteration: the receiver thins out.
  std::function<void(const std::string&)> progress;
  /// Whether to stop; asked often. A run that is stopped throws Interrupted and has written nothing.
  std::function<bool()> stop;

  void report(const std::string& line) const {
    if (progress) progress(line);
  }
  void check() const {
    if (stop && stop()) throw Interrupted();
  }
};

}  // namespace dwell
