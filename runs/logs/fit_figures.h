#pragma once

#include <string>
#include <vector>

#include "paths/feed/machine.h"

namespace dwell {

/// What can be fitted of a machine to the times of runs.
enum class FitFigure {
  PathAcceleration,
  XAcceleration,
  YAcceleration,
  MaxFeed,
  JunctionDeviation,
  CornerDelay,
  Clock,
  BlockDelay
};

/// A machine as a log shows it: times are `clock` times those of the machine, and every block takes `block_delay` more.
struct LoggedMachine {
  Machine machine;
  double clock = 1.0;
  double block_delay = 0.0;  // [s]
};

struct FigureRecord {
  FitFigure figure;
  const char* name;
  const char* key;
  const char* unit;
  bool logarithmic;  // the fit's number is its logarithm
  double scale;      // or the value over this
  double least, most;
  double none;  // the value at which it changes nothing
  bool written;
  double& (*of)(LoggedMachine&);
};

const FigureRecord& record_of(FitFigure figure);

/// From a value to the number that the fit varies, of about 1, and back.
double to_fit(FitFigure figure, double value);
double from_fit(FitFigure figure, double number);

/// The standard error of the value from that of the number.
double error_from_fit(FitFigure figure, double value, double number_error);

}  // namespace dwell
