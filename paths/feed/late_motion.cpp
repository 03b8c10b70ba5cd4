#include "paths/feed/late_motion.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr double kSamePlace = 1e-5;  // mm; a file in inches or turned rounds more than one in mm

bool is_empty_halt(const StrokeMoves& moves, std::size_t i) { return !(moves.steps[i].length() > kSamePlace); }

[[noreturn]] void refuse(const Program& program, std::size_t step, const std::string& why) {
  throw InputError(fmt::format("{}: {} is not of the path that is planned: {}", program.file,
                               step < program.steps.size() ? fmt::format("step {}", step + 1) : "its end", why));
}

}  // namespace

Program late_motion(const Execution& execution, const std::vector<double>& late) {
  Program motion = execution.motion;
  const std::vector<double>& seconds = execution.seconds;
  const auto factor = [&](std::size_t i) { return seconds[i] > 0.0 ? 1.0 + late[i] / seconds[i] : 1.0; };
  std::size_t i = 0;
  double left = seconds.empty() ? 0.0 : seconds[0];  // of step i, not yet given to pieces
  auto at_lift = execution.at_lifts.begin();
  for (std::size_t k = 0; k < motion.steps.size(); ++k) {
    if (at_lift != execution.at_lifts.end() && *at_lift == k) {  // of no step
      ++at_lift;
      continue;
    }
    ProgramStep& piece = motion.steps[k];
    double rest = piece.seconds, sum = 0.0;
    while (rest > 0.0) {
      while (left <= 0.0 && i + 1 < seconds.size()) left = seconds[++i];
      const bool last = i + 1 >= seconds.size();  // takes what rounding has left over
      const double taken = last ? rest : std::min(rest, left);
      sum += taken * factor(i);
      rest -= taken;
      left -= taken;
    }
    piece.seconds = sum;
  }
  return motion;
}

std::vector<Index> strokes_of_steps(const Program& program, const StrokeMoves& moves) {
  std::vector<Index> stroke;
  std::size_t i = 0;
  const auto is_move = [&](const ProgramStep& step) {
    return moves.steps[i].removes && distance(moves.steps[i].start, step.start) <= kSamePlace &&
           distance(moves.steps[i].finish, step.finish) <= kSamePlace;
  };
  for (std::size_t k = 0; k < program.steps.size(); ++k) {
    const ProgramStep& step = program.steps[k];
    if (!step.removes) {
      stroke.push_back(StrokeMoves::kNoStroke);
      continue;
    }
    while (i < moves.size() && !is_move(step)) {
      if (moves.steps[i].removes && !is_empty_halt(moves, i))
        refuse(program, k,
               fmt::format("it runs from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) mm where the path runs from ({:.6g}, "
                           "{:.6g}) to ({:.6g}, {:.6g}) mm",
                           step.start.x, step.start.y, step.finish.x, step.finish.y, moves.steps[i].start.x,
                           moves.steps[i].start.y, moves.steps[i].finish.x, moves.steps[i].finish.y));
      ++i;
    }
    if (i == moves.size()) refuse(program, k, "the path has ended");
    stroke.push_back(moves.stroke[i++]);
  }
  for (; i < moves.size(); ++i) {
    if (moves.steps[i].removes && !is_empty_halt(moves, i)) refuse(program, program.steps.size(), "the path goes on");
  }
  return stroke;
}

Eigen::VectorXd sum_of_strokes(const std::vector<Index>& stroke, const std::vector<double>& values, Index strokes) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(strokes);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (stroke[i] != StrokeMoves::kNoStroke) sum[stroke[i]] += values[i];
  }
  return sum;
}

std::vector<double> late_of_steps(const std::vector<Index>& stroke, const std::vector<double>& seconds,
                                  const Eigen::VectorXd& late) {
  const Eigen::VectorXd whole = sum_of_strokes(stroke, seconds, late.size());
  std::vector<double> shares(stroke.size(), 0.0);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (stroke[i] != StrokeMoves::kNoStroke && whole[stroke[i]] > 0.0)
      shares[i] = late[stroke[i]] * seconds[i] / whole[stroke[i]];
  }
  return shares;
}

}  // namespace dwell
