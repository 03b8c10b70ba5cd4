#include "core/formats/matrix_table.h"
#include "core/formats/matrix_text.h"
#include "core/formats/no_data.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

using dwell::MatrixTable;

/// Whatever the first row and column are taken for, what is left is a map without huge values.
void read_as(std::string_view bytes, const std::optional<MatrixTable>& table) {
  const bool headed = table && table->kind != MatrixTable::Kind::Heights;
  bool named = false;
  dwell::MapSource matrix = dwell::parse_matrix_text(bytes, "map", headed ? &named : nullptr);
  dwell::fuzz::require_sound(matrix);
  dwell::apply_matrix_table(matrix, table, named, "map", "map");
  dwell::fuzz::require_sound(matrix);
  dwell::remove_no_data({&matrix.values, 1.0, matrix.header.no_data}, dwell::NoDataMarkers{}, "map", "map");
  for (const double value : matrix.values) dwell::fuzz::require(!dwell::is_huge_marker(value));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kNmPerMm = 1e6;
  for (const auto& table : {std::optional<MatrixTable>(), std::optional(MatrixTable{}),
                            std::optional(MatrixTable{MatrixTable::Kind::Numbering, "", 0.0}),
                            std::optional(MatrixTable{MatrixTable::Kind::Coordinates, "mm", kNmPerMm})}) {
    dwell::fuzz::read(data, size, [&](std::string_view bytes) { read_as(bytes, table); });
  }
  return 0;
}
