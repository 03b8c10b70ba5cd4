#pragma once

#include <optional>
#include <string>

#include "core/formats/map_source.h"

namespace dwell {

/// What the first row and the first column of a matrix as text are.
struct MatrixTable {
  enum class Kind {
    Heights,      // heights, as all the others
    Numbering,    // numbers or names of rows and columns: left out
    Coordinates,  // y of the rows and x of the columns: pitch and origin are taken from them
  };
  Kind kind = Kind::Heights;
  std::string unit;  // of coordinates, as given
  double unit_nm = 0.0;
};

/// "heights", "index", or a unit of length. Throws InputError naming what is accepted.
MatrixTable parse_matrix_table(const std::string& text);

/// The text that parses to it again.
std::string to_string(const MatrixTable& table);

/// Takes the matrix as `table` says: leaves out a first row and column that are numbers in equal steps (or, with
/// `named_columns`, a first row of names), and takes pitch and origin from coordinates. Adds to its history what it
/// did. Throws InputError that begins with `where` if there is neither such a row nor such a column.
///
/// Without a table a matrix is refused whose first row or column looks like one (in equal steps while no other is, or
/// beside a blank corner), and one whose rows look like points x y z. `name` is "map" or "tif" (the option to name).
/// Cost O(rows x cols).
void apply_matrix_table(MapSource& matrix, const std::optional<MatrixTable>& table, bool named_columns,
                        const std::string& where, const std::string& name);

}  // namespace dwell
