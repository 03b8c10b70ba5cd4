#include "paths/feed/stroke_moves.h"

#include "core/base/segment.h"

namespace dwell {
namespace {

// Feed tables hold coordinates to 1e-6 mm, so each is off by at most 0.71e-6 mm in the plane, and the nodes of a
// stroke, halfway between two of them, by no more: a straight stroke stays straight within twice that.
constexpr double kStraightWithin = 2e-6;

void add(StrokeMoves& moves, Point start, Point finish, bool removes, Index stroke, double share) {
  moves.steps.push_back({start, finish, 0.0, removes});
  moves.stroke.push_back(stroke);
  moves.share.push_back(share);
}

void add_stroke(StrokeMoves& moves, const Stroke& stroke, Index number) {
  if (distance_to_segment(stroke.via, stroke.start, stroke.finish) <= kStraightWithin) {
    add(moves, stroke.start, stroke.finish, true, number, 1.0);
    return;
  }
  const double share = distance(stroke.start, stroke.via) / stroke.length();
  add(moves, stroke.start, stroke.via, true, number, share);
  add(moves, stroke.via, stroke.finish, true, number, 1.0 - share);
}

}  // namespace

std::vector<Stroke> strokes_of(const ToolPath& path, Motion motion) {
  return motion == Motion::Moving ? moving_strokes(path) : halting_strokes(path);
}

StrokeMoves stroke_moves(const ToolPath& path, Motion motion) {
  validate(path);
  const std::vector<Stroke> strokes = strokes_of(path, motion);
  StrokeMoves moves;
  moves.strokes = static_cast<Index>(strokes.size());
  moves.share.reserve(2 * strokes.size());
  moves.steps.reserve(2 * strokes.size());
  moves.stroke.reserve(2 * strokes.size());
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    if (j > 0 && path.lifted[j]) {
      add(moves, strokes[j - 1].finish, strokes[j].start, false, StrokeMoves::kNoStroke, 0.0);
    } else if (j > 0 && motion == Motion::Stop && strokes[j - 1].finish != strokes[j].start) {
      add(moves, strokes[j - 1].finish, strokes[j].start, true, StrokeMoves::kNoStroke, 0.0);
    }
    moves.length.push_back(strokes[j].length());
    add_stroke(moves, strokes[j], static_cast<Index>(j));
  }
  return moves;
}

}  // namespace dwell
