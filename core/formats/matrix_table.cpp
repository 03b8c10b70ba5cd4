#include "core/formats/matrix_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/map/value_units.h"
#include "core/numerics/lattice_fit.h"

namespace dwell {
namespace {

constexpr double kExactSteps = 1e-9;    // of the largest number: equal steps, but for the rounding of doubles
constexpr double kRoundedSteps = 0.05;  // of the step: as kLatticeTolerance, for coordinates printed with few digits
// Of the step: the most that one of the last digit may be, for four numbers and for eight. Fewer are soon in equal
// steps to their rounding.
constexpr double kPrintedSteps = 0.12, kPrintedStepsOfMany = 0.34;
constexpr Index kLeastPrinted = 4, kManyPrinted = 8;
constexpr Index kLeastAlone = 5;  // numbers in equal steps beside a corner that is a number: four may be an accident
constexpr Index kTelling = 3;     // two numbers are always in equal steps
constexpr Index kLeastPoints = 9;
constexpr Index kFewColumns = 6, kManyRows = 100;

/// A row or column of the matrix, or a part of it.
struct MatrixLine {
  const MapSource* matrix;
  std::size_t first, stride;
  Index count;

  double operator[](Index i) const { return matrix->values[first + stride * static_cast<std::size_t>(i)]; }
  MatrixLine without_first() const { return {matrix, first + stride, stride, count - 1}; }
};

MatrixLine matrix_row(const MapSource& m, Index row) { return {&m, static_cast<std::size_t>(row * m.cols), 1, m.cols}; }
MatrixLine matrix_column(const MapSource& m, Index col) {
  return {&m, static_cast<std::size_t>(col), static_cast<std::size_t>(m.cols), m.rows};
}

/// Numbers in equal steps.
struct Steps {
  double first = 0.0, step = 0.0;
  Index count = 0;
  double rounding = 0.0;  // how well the step is known, as a part of it: the numbers are printed with few digits
};

/// One of the last digit that the numbers are printed with; 0 if they have more digits than a table shows.
double printed_unit(const MatrixLine& line) {
  constexpr int kMostDigits = 6;
  constexpr double kWhole = 1e-6;
  double scale = 1.0;
  for (int digits = 0; digits <= kMostDigits; ++digits, scale *= 10.0) {
    bool whole = true;
    for (Index i = 0; i < line.count && whole; ++i) {
      whole = std::abs(line[i] * scale - std::round(line[i] * scale)) <= kWhole;
    }
    if (whole) return 1.0 / scale;
  }
  return 0.0;
}

/// The line as numbers in equal steps, if it is: to `exact` of the largest number, to `rounded` of the step, or to the
/// rounding of the digits that are printed (0.094, 0.188, 0.281), if these are some for each step.
std::optional<Steps> steps_of(const MatrixLine& line, Index least, double exact, double rounded) {
  if (line.count < std::max<Index>(least, 2)) return std::nullopt;
  const double first = line[0], last = line[line.count - 1],
               step = (last - first) / static_cast<double>(line.count - 1);
  if (!std::isfinite(step) || step == 0.0) return std::nullopt;
  const double printed = line.count >= kLeastPrinted ? printed_unit(line) : 0.0;
  double tolerance = std::max(exact * std::max(std::abs(first), std::abs(last)), rounded * std::abs(step));
  const double most = line.count >= kManyPrinted ? kPrintedStepsOfMany : kPrintedSteps;
  if (printed <= most * std::abs(step)) tolerance = std::max(tolerance, printed);
  for (Index i = 0; i < line.count; ++i) {
    if (!(std::abs(line[i] - first - step * static_cast<double>(i)) <= tolerance)) return std::nullopt;
  }
  return Steps{first, step, line.count, printed / static_cast<double>(line.count - 1) / std::abs(step)};
}

/// Whether a line besides the first is in equal steps too, as all are of a tilted plane.
bool another_is_even(const MapSource& m, bool rows) {
  constexpr Index kLeast = 3;
  for (Index i = 1; i < (rows ? m.rows : m.cols); ++i) {
    const MatrixLine line = rows ? matrix_row(m, i) : matrix_column(m, i);
    if (steps_of(line, kLeast, kExactSteps, kRoundedSteps) ||
        steps_of(line.without_first(), kLeast, kExactSteps, kRoundedSteps))
      return true;
  }
  return false;
}

/// The first row and column, where they are no heights.
struct Headings {
  std::optional<Steps> x, y;  // of the first row, without the corner if there is a first column; and of that column
  bool row = false, column = false;
};

/// What a matrix without a word of the user looks like.
Headings suspected(const MapSource& m) {
  const MatrixLine row = matrix_row(m, 0), column = matrix_column(m, 0);
  const bool blank = std::isnan(m.values[0]);
  const double rounded = blank ? kRoundedSteps : 0.0;
  Headings both;
  both.x = steps_of(row.without_first(), blank ? 2 : kLeastAlone - 1, kExactSteps, rounded);
  both.y = steps_of(column.without_first(), blank ? 2 : kLeastAlone - 1, kExactSteps, rounded);
  both.row = both.column = true;
  const auto tells = [&](const std::optional<Steps>& steps, bool rows) {
    return steps && steps->count >= kTelling && !another_is_even(m, rows);
  };
  if (both.x && both.y && (tells(both.x, true) || tells(both.y, false))) return both;
  // Beside an empty corner one of the two says that both are there.
  const auto headed = [&](const std::optional<Steps>& steps, bool rows) {
    return blank && steps && steps->count >= kLeastAlone && tells(steps, rows);
  };
  if (headed(both.x, true) || headed(both.y, false)) return both;
  Headings one;
  if (m.rows > 1) one.x = steps_of(row, kLeastAlone, kExactSteps, 0.0);
  if (tells(one.x, true)) return one.row = true, one;
  one.x.reset();
  if (m.cols > 1) one.y = steps_of(column, kLeastAlone, kExactSteps, 0.0);
  if (tells(one.y, false)) return one.column = true, one;
  return {};
}

/// What the user says is there.
Headings stated(const MapSource& m, bool named_columns) {
  const MatrixLine row = matrix_row(m, 0), column = matrix_column(m, 0);
  const bool blank = std::isnan(m.values[0]) || named_columns;
  Headings found;
  const Index least = blank ? 2 : kTelling;
  found.x = steps_of(row.without_first(), least, kExactSteps, kRoundedSteps);
  found.y = steps_of(column.without_first(), least, kExactSteps, kRoundedSteps);
  const auto whole_x = steps_of(row, kTelling, kExactSteps, kRoundedSteps),
             whole_y = steps_of(column, kTelling, kExactSteps, kRoundedSteps);
  // A corner that goes on in the steps of its row or column alone belongs to it.
  if (!blank && whole_x && !(found.x && found.y && !whole_y))
    found = {whole_x, {}, true, false};
  else if (!blank && whole_y)
    found = {{}, whole_y, false, true};
  else
    found.row = named_columns || found.x.has_value(), found.column = found.y.has_value();
  // An empty corner stands above a column, and beside a row, of headings.
  if (std::isnan(m.values[0]) && !named_columns && (found.row || found.column)) found.row = found.column = true;
  return found;
}

std::string in_words(const Headings& h) {
  const auto line = [](const char* what, const std::optional<Steps>& s) {
    if (!s) return fmt::format("the first {}", what);
    return fmt::format("the first {} ({} from {} in steps of {:.9g})", what, counted(s->count, "number"), s->first,
                       s->step);
  };
  const std::string row = h.row ? line("row", h.x) : "", column = h.column ? line("column", h.y) : "";
  return row + (h.row && h.column ? " and " : "") + column;
}

/// Whether the line is in equal steps, its first number left out or not, and of those that may be heights none is.
std::optional<Steps> lone_last(const MapSource& m, bool rows) {
  const Index count = rows ? m.rows : m.cols;
  const auto even = [&](Index i) {
    const MatrixLine line = rows ? matrix_row(m, i) : matrix_column(m, i);
    const auto whole = steps_of(line, kLeastAlone, kExactSteps, 0.0);
    return whole ? whole : steps_of(line.without_first(), kLeastAlone, kExactSteps, 0.0);
  };
  const auto last = count > kTelling ? even(count - 1) : std::nullopt;
  if (!last) return std::nullopt;
  for (Index i = 1; i + 1 < count; ++i) {
    if (even(i)) return std::nullopt;
  }
  return last;
}

/// Coordinates that stand behind the heights.
void refuse_last(const MapSource& m, const std::string& where, const std::string& name) {
  for (const bool rows : {false, true}) {
    const auto last = lone_last(m, rows);
    if (!last) continue;
    throw InputError(fmt::format(
        "{}: the last {} ({} from {} in steps of {:.9g}) looks like an index or coordinates, not "
        "like heights; put it first and give `{} table` index or mm, or leave it out of the file, or give "
        "`{} table` heights to take it as heights",
        where, rows ? "row" : "column", counted(last->count, "number"), last->first, last->step, name, name));
  }
}

/// What of the first row and column is missing, for messages.
std::string missing_in_words(const Headings& found) {
  if (!found.x && !found.y) return "first row and column are no numbers";
  return found.x ? "first column is no numbers" : "first row is no numbers";
}

/// Whether the rows look like points: x and y on a grid of which they fill a quarter at least.
bool looks_like_points(const MapSource& m) {
  if (m.cols < 3 || m.cols > kFewColumns || m.rows < kLeastPoints) return false;
  if (m.cols == 3 && m.rows >= kManyRows) return true;
  Lattice axes[2];
  for (Index col = 0; col < 2; ++col) {
    std::vector<double> v;
    for (Index row = 0; row < m.rows; ++row) v.push_back(matrix_column(m, col)[row]);
    if (std::any_of(v.begin(), v.end(), [](double x) { return !std::isfinite(x); })) return false;
    const LatticeFit fit = fit_lattice(std::move(v));
    if (!fit.fits || fit.lattice.count < 2) return false;
    axes[col] = fit.lattice;
  }
  const double places = static_cast<double>(axes[0].count) * static_cast<double>(axes[1].count);
  constexpr double kFilled = 0.25;
  return static_cast<double>(m.rows) >= kFilled * places && static_cast<double>(m.rows) <= places;
}

void refuse_suspicious(const MapSource& m, const std::string& where, const std::string& name) {
  if (looks_like_points(m)) {
    throw InputError(fmt::format(
        "{}: its {} of {} numbers look like points x y z, not like a matrix of heights; name it .xyz or begin it "
        "with a line 'x y z' (and leave other columns out), or give `{} table` heights to take every number as a "
        "height",
        where, counted(m.rows, "row"), m.cols, name));
  }
  const Headings found = suspected(m);
  if (!found.row && !found.column) return;
  throw InputError(fmt::format(
      "{}: {} {} like an index or coordinates, not like heights; give `{} table` index to leave them out, `{} table` "
      "mm (or another unit of length) to take pitch and origin from them, or `{} table` heights to take them as "
      "heights",
      where, in_words(found), found.row && found.column ? "look" : "looks", name, name, name));
}

void leave_out(MapSource& m, const Headings& h) {
  const Index row_0 = h.row ? 1 : 0, col_0 = h.column ? 1 : 0;
  std::vector<double> values;
  for (Index row = row_0; row < m.rows; ++row) {
    for (Index col = col_0; col < m.cols; ++col) values.push_back(matrix_row(m, row)[col]);
  }
  m.rows -= row_0;
  m.cols -= col_0;
  m.values = std::move(values);
}

/// Turns the order of rows or columns whose coordinates fall.
void make_rising(MapSource& m, Headings& h) {
  const auto turn = [](Steps& s) {
    s.first += s.step * static_cast<double>(s.count - 1);
    s.step = -s.step;
  };
  if (h.x->step < 0.0) {
    for (Index row = 0; row < m.rows; ++row) {
      const auto begin = m.values.begin() + row * m.cols;
      std::reverse(begin, begin + m.cols);
    }
    turn(*h.x);
  }
  if (h.y->step < 0.0) {
    for (Index row = 0; row < m.rows / 2; ++row) {
      const auto begin = m.values.begin() + row * m.cols;
      std::swap_ranges(begin, begin + m.cols, m.values.begin() + (m.rows - 1 - row) * m.cols);
    }
    turn(*h.y);
  }
}

void take_coordinates(MapSource& m, Headings& h, const MatrixTable& table, const std::string& where) {
  make_rising(m, h);
  const double mm = table.unit_nm / units::kNmPerMm;
  const Point pitch{h.x->step * mm, h.y->step * mm}, origin{h.x->first * mm, h.y->first * mm};
  constexpr double kStepAgreement = 1e-3;  // of the pitch
  const double rounding = std::max({kStepAgreement, h.x->rounding, h.y->rounding});
  const auto agree = [&](double a, double b, double size) { return std::abs(a - b) <= rounding * size; };
  const MapHeader& said = m.header;
  if ((said.pitch && !(agree(said.pitch->x, pitch.x, pitch.x) && agree(said.pitch->y, pitch.y, pitch.y))) ||
      (said.origin && !(agree(said.origin->x, origin.x, pitch.x) && agree(said.origin->y, origin.y, pitch.y)))) {
    throw InputError(fmt::format(
        "{}: its coordinates in {} say a pitch of {} x {} mm and an origin of {},{} mm, but its header says "
        "otherwise; they must agree",
        where, table.unit, pitch.x, pitch.y, origin.x, origin.y));
  }
  if (!said.pitch) m.header.pitch_rounding = rounding;
  if (!said.pitch) m.header.pitch = pitch;
  if (!said.origin) m.header.origin = origin;
}

}  // namespace

MatrixTable parse_matrix_table(const std::string& text) {
  if (text == "heights") return {};
  if (text == "index") return {MatrixTable::Kind::Numbering, "", 0.0};
  if (const auto unit = known_length_unit(text)) return {MatrixTable::Kind::Coordinates, text, *unit};
  throw InputError(fmt::format("'{}'; accepted: heights, index, or the unit of coordinates (mm, um, m)", text));
}

std::string to_string(const MatrixTable& table) {
  switch (table.kind) {
    case MatrixTable::Kind::Heights:
      return "heights";
    case MatrixTable::Kind::Numbering:
      return "index";
    case MatrixTable::Kind::Coordinates:
      return table.unit;
  }
  return "";
}

void apply_matrix_table(MapSource& matrix, const std::optional<MatrixTable>& table, bool named_columns,
                        const std::string& where, const std::string& name) {
  if (!table) refuse_suspicious(matrix, where, name);
  if (!table || table->kind != MatrixTable::Kind::Heights) refuse_last(matrix, where, name);
  if (!table || table->kind == MatrixTable::Kind::Heights) return;
  const bool coordinates = table->kind == MatrixTable::Kind::Coordinates;
  Headings found = stated(matrix, named_columns);
  if (coordinates ? !(found.x && found.y) : !(found.row || found.column)) {
    throw InputError(fmt::format("{}: `{} table` {}, but its {} in equal steps{}; leave the option out", where, name,
                                 to_string(*table), missing_in_words(found),
                                 coordinates && (found.x || found.y)
                                     ? ", and coordinates are needed of both (or give index, and the pitch)"
                                     : ""));
  }
  if (matrix.rows <= (found.row ? 1 : 0) || matrix.cols <= (found.column ? 1 : 0)) {
    throw InputError(fmt::format("{}: nothing is left without {}", where, in_words(found)));
  }
  const auto is_falling = [](const std::optional<Steps>& steps) { return steps && steps->step < 0.0; };
  if (!coordinates && (is_falling(found.x) || is_falling(found.y))) {
    throw InputError(
        fmt::format("{}: {}: falling coordinates would turn the map over; give `{} table` mm (or another "
                    "unit of length)",
                    where, in_words(found), name));
  }
  const std::string what = in_words(found);
  leave_out(matrix, found);
  if (coordinates) take_coordinates(matrix, found, *table, where);
  matrix.header.history.push_back(coordinates ? fmt::format("table: {} taken as x and y in {}", what, table->unit)
                                              : fmt::format("table: {} left out", what));
}

}  // namespace dwell
