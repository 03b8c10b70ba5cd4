#include "core/formats/said_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;

constexpr double kSameStatement = 1e-9;

const char* name_of(SaidLayout::What what, SaidLayout::Axis axis) {
  const bool x = axis == SaidLayout::Axis::X;
  switch (what) {
    case SaidLayout::What::Pitch:
      return x ? "pitch in x" : "pitch in y";
    case SaidLayout::What::Size:
      return x ? "width" : "height";
    case SaidLayout::What::Origin:
      return x ? "origin in x" : "origin in y";
  }
  return "";
}

}  // namespace

bool statements_agree(double a, double b, double rounding) {
  return std::abs(a - b) <= std::max(rounding, kSameStatement) * std::max(std::abs(a), std::abs(b));
}

void SaidLayout::set(What what, Axis axis, const Length& length, const std::string& place) {
  Pair& pair = what == What::Pitch ? pitch_ : what == What::Size ? size_ : origin_;
  std::optional<Length>& slot = pair[static_cast<std::size_t>(axis)];
  if (slot && !statements_agree(slot->mm, length.mm, slot->rounding + length.rounding)) {
    throw InputError(fmt::format("{}: {} gives a {} of {} mm, but {} above {} mm; they must agree", place, length.key,
                                 name_of(what, axis), length.mm, slot->key, slot->mm));
  }
  if (!slot) slot = length;
}

void SaidLayout::add_counts(const std::vector<double>& numbers, const std::string& message) {
  counts_.push_back({numbers, message});
}

std::optional<Point> SaidLayout::both(const Pair& pair, About about, const char* what, MapHeader& header) const {
  if (pair[0] && pair[1]) return Point{pair[0]->mm, pair[1]->mm};
  if (pair[0] || pair[1]) {
    const std::string& key = (pair[0] ? pair[0] : pair[1])->key;
    header.unclear.push_back(
        {about, fmt::format("{}: {} says the {} in one direction only; both are required", where_, key, what)});
  }
  return std::nullopt;
}

void SaidLayout::add_to(MapHeader& header) const {
  header.pitch = both(pitch_, About::Pitch, "pitch", header);
  header.origin = both(origin_, About::Origin, "origin", header);
  if (!height_message_.empty() && !size_[0]) header.unclear.push_back({About::Factor, height_message_});
}

void SaidLayout::add_counts_to(MapHeader& header, Index rows, Index cols) const {
  for (const Counts& counts : counts_) {
    const bool all = std::all_of(counts.numbers.begin(), counts.numbers.end(), [&](double number) {
      return number == static_cast<double>(rows) || number == static_cast<double>(cols) ||
             number == static_cast<double>(rows * cols);
    });
    if (!all) header.unclear.push_back({About::Pitch, counts.message});
  }
}

void SaidLayout::add_sizes(MapHeader& header, Index rows, Index cols) const {
  add_counts_to(header, rows, cols);
  if (!size_[0] && !size_[1]) return;
  if (!gwyddion_ || !size_[0] || !size_[1]) {
    const Length& size = size_[0] ? *size_[0] : *size_[1];
    header.unclear.push_back(
        {About::Pitch, fmt::format("{}: {} = {} mm: over all pixels, or from the first to the last? Write "
                                   "'# pitch_mm: 0.1'",
                                   where_, size.key, size.mm)});
    return;
  }
  const Point pitch{size_[0]->mm / static_cast<double>(cols), size_[1]->mm / static_cast<double>(rows)};
  const double rounding = std::max({size_[0]->rounding, size_[1]->rounding, kSameStatement});
  if (!header.pitch) {
    header.pitch = pitch;
    header.pitch_rounding = rounding;
  } else if (!statements_agree(header.pitch->x, pitch.x, rounding) ||
             !statements_agree(header.pitch->y, pitch.y, rounding)) {
    throw InputError(fmt::format("{}: {} and {} say a pitch of {} x {} mm, but {} says {} x {} mm; they must agree",
                                 where_, size_[0]->key, size_[1]->key, pitch.x, pitch.y, pitch_[0]->key,
                                 header.pitch->x, header.pitch->y));
  }
}

}  // namespace dwell
