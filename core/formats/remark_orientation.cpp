#include "core/formats/remark_orientation.h"

#include <string>

#include "core/base/number_text.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 27> kTop{
    "top",     "upper",    "oben",          "haut",      "down",    "downward",   "downwards",  "topmost",   "top-down",
    "largest", "greatest", "highest",       "top-left",  "topleft", "ymax",       "upper-left", "upperleft", "arriba",
    "unten",   "bas",      "right-to-left", "groesstes", "max",     "decreasing", "descending", "alto",      "abajo"};

bool is_turned(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 28> kTurned{
      "clocked",  "flipped",    "mirrored", "transposed", "rotated",      "upside",      "upside-down",
      "inverted", "gespiegelt", "gedreht",  "retourne",   "retournee",    "flipud",      "fliplr",
      "reversed", "y-down",     "turned",   "transpose",  "transponiert", "inverse",     "rot90",
      "rot180",   "rot270",     "volteado", "girado",     "capovolto",    "left-handed", "lefthanded"};
  if (!is_among(words[at].folded, kTurned) || is_denied(words, at)) return false;
  const bool by = at + 1 < words.size() && (words[at + 1].folded == "by" || words[at + 1].folded == "to");
  const std::size_t next = by ? at + 2 : at + 1;
  return !(next < words.size() && finite_number(words[next].text) == std::optional(0.0));
}

/// "viewed from the back", "seen through the substrate", "rear view", "mirror image".
bool is_seen_from_behind(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 12> kViews{"viewed",  "seen", "looking", "view",  "looked", "ansicht",
                                                    "gesehen", "vu",   "vue",     "visto", "vista",  "observed"};
  constexpr std::array<std::string_view, 16> kBehind{
      "back",  "behind",  "rear",     "below", "underneath", "beneath",   "hinten",  "rueckseite",
      "unten", "arriere", "derriere", "dos",   "through",    "underside", "reverse", "detras"};
  const std::string& word = words[at].folded;
  if (word == "mirror" && at + 1 < words.size() && words[at + 1].folded.starts_with("imag")) return true;
  constexpr std::size_t kReach = 5;
  if (!is_among(word, kViews)) return false;
  for (std::size_t i = at > 0 ? at - 1 : 0; i < std::min(words.size(), at + kReach); ++i) {
    if (is_among(words[i].folded, kBehind)) return true;
  }
  return false;
}

char axis_of(const RemarkWord& word) {
  for (const char axis : {'x', 'y'}) {
    const std::string letter(1, axis);
    for (const std::string& name : {letter, letter + "-axis", letter + "axis", letter + "-direction", letter + "_axis"})
      if (word.folded == name) return axis;
  }
  return '\0';
}

/// A letter x between numbers, or between rows and columns, means times.
bool means_times(const Remark& words, std::size_t at) {
  const bool plain = words[at].folded == "x" && words[at].before == ' ' && at > 0 && at + 1 < words.size();
  if (!plain || words[at + 1].before != ' ') return false;
  const bool number = words[at - 1].number || words[at + 1].number;
  return number || words[at + 1].folded.starts_with("col") || words[at + 1].folded.starts_with("row");
}

/// "x to the left", "x axis points left".
bool points_left(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 7> kLeft{"left",   "leftward",  "leftwards", "links",
                                                  "gauche", "izquierda", "left."};
  constexpr std::array<std::string_view, 5> kArticles{"the", "nach", "vers", "la", "a"};
  constexpr std::array<std::string_view, 14> kTo{"to",    "points",  "pointing", "point",     "runs",
                                                 "run",   "towards", "toward",   "increases", "increasing",
                                                 "zeigt", "goes",    "axis",     "is"};
  if (axis_of(words[at]) != 'x' || means_times(words, at)) return false;
  for (std::size_t i = at + 1; i < words.size() && !(words[i].clause && words[i].before != ' '); ++i) {
    if (!is_among(words[i].folded, kLeft)) continue;
    std::size_t before = i - 1;
    const bool article = is_among(words[before].folded, kArticles);
    if (article && before > at) --before;
    return before == at || is_among(words[before].folded, kTo);
  }
  return false;
}

enum class ArrayIndex { None, Row, Column };

/// "rows", "first index", "axis 0", "slow axis": which index of an array the word at the place names.
ArrayIndex index_of(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 8> kRowNames{"row",    "rows",  "row_index", "zeile",
                                                      "zeilen", "filas", "fila",      "axis0"};
  constexpr std::array<std::string_view, 10> kColumnNames{"column", "columns", "col",      "cols",     "col_index",
                                                          "spalte", "spalten", "colonnes", "columnas", "axis1"};
  constexpr std::array<std::string_view, 6> kFirst{"first", "1st", "outer", "slow", "slowest", "erster"};
  constexpr std::array<std::string_view, 7> kLast{"second", "2nd", "last", "inner", "fast", "fastest", "zweiter"};
  constexpr std::array<std::string_view, 5> kIndices{"index", "axis", "dimension", "dim", "coordinate"};
  const std::string& word = words[at].folded;
  if (is_among(word, kRowNames)) return ArrayIndex::Row;
  if (is_among(word, kColumnNames)) return ArrayIndex::Column;
  if (at + 1 >= words.size()) return ArrayIndex::None;
  const std::string& next = words[at + 1].folded;
  if (is_among(word, kFirst) && is_among(next, kIndices)) return ArrayIndex::Row;
  if (is_among(word, kLast) && is_among(next, kIndices)) return ArrayIndex::Column;
  if (!is_among(word, kIndices) || words[at + 1].before != ' ') return ArrayIndex::None;
  return next == "0" ? ArrayIndex::Row : next == "1" ? ArrayIndex::Column : ArrayIndex::None;
}

/// Pairs each index that is named with the axis next to it, in either order: "rows = x", "x is the row index". A row
/// that lies along x is as it should be, for there the other index runs.
bool exchanges_indices(const Remark& words) {
  ArrayIndex index = ArrayIndex::None;
  char axis = '\0';
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].clause) index = ArrayIndex::None, axis = '\0';
    const bool along = words[i].folded == "along" || words[i].folded == "entlang";
    if (along)
      index = index == ArrayIndex::Row ? ArrayIndex::Column : index == ArrayIndex::Column ? ArrayIndex::Row : index;
    if (const ArrayIndex here = index_of(words, i); here != ArrayIndex::None && index == ArrayIndex::None) index = here;
    if (const char here = axis_of(words[i]); here != '\0' && !means_times(words, i)) axis = here;
    if (index == ArrayIndex::None || axis == '\0') continue;
    if ((index == ArrayIndex::Row) != (axis == 'y')) return true;
    index = ArrayIndex::None, axis = '\0';
  }
  return false;
}

bool names_columns_first(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 5> kOrders{"column-major", "col-major", "columnmajor", "f-order",
                                                    "fortran-order"};
  const bool fortran = words[at].folded == "fortran" || words[at].text == "F";
  const bool order = at + 1 < words.size() && (words[at + 1].folded == "order" || words[at + 1].folded == "ordering");
  return is_among(words[at].folded, kOrders) || (fortran && order);
}

/// Whether a word of the list stands at most four words before the place.
template <class Words>
bool is_near_before(const Remark& words, std::size_t at, const Words& known) {
  constexpr std::size_t kReach = 4;
  for (std::size_t i = at > kReach ? at - kReach : 0; i < at; ++i) {
    if (is_among(words[i].folded, known)) return true;
  }
  return false;
}

/// "array is [x, y]", "indexed as z[ix][iy]", "index order x, y": the first index is that of the columns. A list of
/// three, as "columns [x, y, z]", is none of indices.
bool indexes_columns_first(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 8> kFirst{"x", "nx", "ix", "col", "column", "columns", "cols", "ncols"};
  constexpr std::array<std::string_view, 7> kSecond{"y", "ny", "iy", "row", "rows", "nrows", "line"};
  constexpr std::array<std::string_view, 33> kArrays{
      "array",       "arrays",   "matrix",  "data",    "values",  "map",        "heights",    "height", "image",
      "img",         "z",        "index",   "indices", "indexed", "indexing",   "shape",      "stored", "order",
      "ordered",     "layout",   "dims",    "h",       "axes",    "dimensions", "subscripts", "feld",   "matrize",
      "reihenfolge", "ordering", "indexes", "a",       "tableau", "ordre"};
  constexpr std::array<std::string_view, 7> kOrders{"order",  "ordering",    "ordered", "indexing",
                                                    "layout", "reihenfolge", "ordre"};
  if (!is_among(words[at].folded, kFirst) || at + 1 >= words.size() || !is_among(words[at + 1].folded, kSecond)) {
    return false;
  }
  // "image size (x, y)", "data points [x, y]"
  constexpr std::array<std::string_view, 20> kOfOthers{
      "size",   "pixels", "resolution", "range",     "pitch",  "spacing",     "step",   "centre", "center", "origin",
      "offset", "points", "position",   "positions", "extent", "coordinates", "places", "sizes",  "pixel",  "point"};
  if (is_near_before(words, at, kOfOthers)) return false;
  const char before_second = words[at + 1].before;
  const bool listed = words[at].bracketed() && (before_second == ',' || before_second == ' ') && words[at + 1].closed;
  const bool subscripts = words[at].before == '[' && words[at].closed && before_second == '[' && words[at + 1].closed;
  if (subscripts || (listed && is_near_before(words, at, kArrays))) return true;
  const bool ends = at + 2 == words.size() || words[at + 2].clause;
  return before_second == ',' && ends && is_near_before(words, at, kOrders);
}

/// "image coordinates", "screen convention": y runs down there.
bool names_image_axes(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 8> kDown{"image",   "screen", "display", "bitmap",
                                                  "picture", "camera", "matrix",  "raster"};
  constexpr std::array<std::string_view, 6> kAxes{"coordinates", "coordinate",  "coords",
                                                  "convention",  "conventions", "axes"};
  constexpr std::array<std::string_view, 4> kOne{"bildkoordinaten", "bildschirmkoordinaten", "kamerakoordinaten",
                                                 "image-coordinates"};
  if (is_among(words[at].folded, kOne)) return true;
  return is_among(words[at].folded, kDown) && at + 1 < words.size() && is_among(words[at + 1].folded, kAxes);
}

template <class Rule>
bool any_place(const Remark& words, Rule rule) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (rule(words, i)) return true;
  }
  return false;
}

}  // namespace

bool speaks_of_rows(const Remark& words) {
  constexpr std::array<std::string_view, 23> kRowWords{
      "row",      "rows",    "line",       "lines", "zeile", "zeilen", "ligne",  "lignes",
      "image",    "origin",  "index",      "row0",  "pixel", "first",  "column", "columns",
      "ursprung", "origine", "upper-left", "fila",  "filas", "riga",   "righe"};
  return (holds_any(words, kRowWords) && holds_any(words, kTop)) || exchanges_indices(words) ||
         any_place(words, names_columns_first) || any_place(words, indexes_columns_first);
}

bool speaks_of_axes(const Remark& words) {
  constexpr std::array<std::string_view, 5> kAxes{"y", "y-axis", "yaxis", "y_axis", "y-direction"};
  return any_place(words, is_turned) || any_place(words, is_seen_from_behind) || any_place(words, points_left) ||
         any_place(words, names_image_axes) || (holds_any(words, kAxes) && holds_any(words, kTop));
}

bool names_orientation(std::string_view remark) {
  const Remark words = remark_words(remark);
  return speaks_of_rows(words) || speaks_of_axes(words);
}

bool speaks_of_a_sign(const Remark& words) {
  constexpr std::array<std::string_view, 4> kNegated{"negated", "sign-reversed", "sign-flipped", "negiert"};
  constexpr std::array<std::string_view, 3> kSigns{"sign", "signs", "vorzeichen"};
  constexpr std::array<std::string_view, 14> kOther{"negative", "minus",    "opposite", "umgekehrt", "-",
                                                    "-1",       "reversed", "inverted", "flipped",   "changed",
                                                    "inverse",  "invers",   "wrong",    "negativ"};
  constexpr std::array<std::string_view, 4> kPositive{"positive", "positiv", "positif", "positives"};
  constexpr std::array<std::string_view, 5> kNegative{"negative", "negativ", "negatif", "minus", "negatives"};
  constexpr std::array<std::string_view, 17> kLow{"down", "hole",     "holes",     "depression", "depressions", "low",
                                                  "into", "valley",   "valleys",   "concave",    "deep",        "pit",
                                                  "pits", "downward", "downwards", "loch",       "creux"};
  constexpr std::array<std::string_view, 11> kHigh{"up",     "bump",   "bumps",   "high",       "hill",  "hills",
                                                   "raised", "upward", "upwards", "protrusion", "excess"};
  constexpr std::size_t kReach = 4;
  const auto near = [&](std::size_t at, const auto& list) {
    const std::size_t begin = at > kReach ? at - kReach : 0, end = std::min(words.size(), at + kReach + 1);
    for (std::size_t i = begin; i < end; ++i) {
      if (is_among(words[i].folded, list) && !is_denied(words, i)) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i].folded;
    if (is_among(word, kNegated) && !is_denied(words, i)) return true;
    if (is_among(word, kSigns) && near(i, kOther)) return true;
    if (is_among(word, kPositive) && near(i, kLow)) return true;
    if (is_among(word, kNegative) && near(i, kHigh)) return true;
  }
  return false;
}

}  // namespace dwell
