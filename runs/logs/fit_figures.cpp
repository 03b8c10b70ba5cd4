#include "runs/logs/fit_figures.h"

#include <array>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

constexpr std::array<FigureRecord, 8> kRecords{
    {{FitFigure::PathAcceleration, "acceleration along the path", "path_acceleration", "mm/s^2", true, 1.0, 1e-2, 1e7,
      kNoLimit, true, [](LoggedMachine& m) -> double& { return m.machine.path_acceleration; }},
     {FitFigure::XAcceleration, "acceleration of x", "x_acceleration", "mm/s^2", true, 1.0, 1e-2, 1e7, kNoLimit, true,
      [](LoggedMachine& m) -> double& { return m.machine.x.max_acceleration; }},
     {FitFigure::YAcceleration, "acceleration of y", "y_acceleration", "mm/s^2", true, 1.0, 1e-2, 1e7, kNoLimit, true,
      [](LoggedMachine& m) -> double& { return m.machine.y.max_acceleration; }},
     {FitFigure::MaxFeed, "speed limit along the path", "max_feed", "mm/s", true, 1.0, 1e-4, 1e5, kNoLimit, true,
      [](LoggedMachine& m) -> double& { return m.machine.max_feed; }},
     {FitFigure::JunctionDeviation, "junction deviation", "junction_deviation", "mm", true, 1.0, 1e-7, 1e2, kNoLimit,
      true, [](LoggedMachine& m) -> double& { return m.machine.junction_deviation; }},
     {FitFigure::CornerDelay, "delay at a corner", "corner_delay", "s", false, 1e-3, 0.0, 10.0, 0.0, true,
      [](LoggedMachine& m) -> double& { return m.machine.corner_delay; }},
     {FitFigure::Clock, "scale of the log's clock", "clock_scale", "", false, 1.0, 1e-2, 1e2, 1.0, false,
      [](LoggedMachine& m) -> double& { return m.clock; }},
     {FitFigure::BlockDelay, "delay a block", "block_delay", "s", false, 1e-3, -1.0, 10.0, 0.0, false,
      [](LoggedMachine& m) -> double& { return m.block_delay; }}}};

}  // namespace

const FigureRecord& record_of(FitFigure figure) { return kRecords[static_cast<std::size_t>(figure)]; }

double to_fit(FitFigure figure, double value) {
  const FigureRecord& record = record_of(figure);
  return record.logarithmic ? std::log(value) : value / record.scale;
}

double from_fit(FitFigure figure, double number) {
  const FigureRecord& record = record_of(figure);
  return record.logarithmic ? std::exp(number) : number * record.scale;
}

double error_from_fit(FitFigure figure, double value, double number_error) {
  const FigureRecord& record = record_of(figure);
  return number_error * (record.logarithmic ? value : record.scale);
}

}  // namespace dwell
