#pragma once

#include <functional>
#include <string>
#include <utility>

#include "core/base/errors.h"

namespace dwell {

/// How a long computation talks to whoever started it: one handle, handed down from the program to planners, solvers,
/// readers and writers. Both functions may be empty: then nothing is shown and nothing stops. Whatever can take over
/// two seconds asks it at least four times a second. Called by one thread at a time.
struct Progress {
  /// Shown how far the computation is, one line with units. Called as often as there is news: the receiver drops what
  /// comes too fast.
  std::function<void(const std::string& line)> show{};
  /// Whether to stop; asked often. What is stopped throws Interrupted and has written nothing.
  std::function<bool()> stop{};

  void report(const std::string& line) const {
    if (show) show(line);
  }
  bool stop_asked() const { return stop && stop(); }
  /// Throws Interrupted if the computation is to stop.
  void check() const {
    if (stop_asked()) throw Interrupted();
  }
  /// Reports, then checks.
  void step(const std::string& line) const {
    report(line);
    check();
  }
  /// The same handle for a part of the computation: its lines begin with the name of the part.
  Progress of_part(const std::string& name) const {
    Progress part;
    if (show) part.show = [whole = show, name](const std::string& line) { whole(name + ": " + line); };
    part.stop = stop;
    return part;
  }
};

}  // namespace dwell
