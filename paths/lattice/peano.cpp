#include "paths/lattice/peano.h"

namespace dwell {
namespace {

/// State bits: 1 = columns mirrored, 2 = rows mirrored.
FillingCurve peano_curve() {
  FillingCurve curve{3, {}};
  for (unsigned state = 0; state < 4; ++state) {
    std::vector<FillingCurve::Block> blocks;
    for (unsigned k = 0; k < 9; ++k) {  // up the first column, down the second, up the third
      const unsigned col = k / 3, row = col == 1 ? 2 - k % 3 : k % 3;
      const unsigned change = (row & 1U) | ((col & 1U) << 1);
      blocks.push_back({static_cast<std::uint8_t>((state & 2U) != 0 ? 2 - row : row),
                        static_cast<std::uint8_t>((state & 1U) != 0 ? 2 - col : col),
                        static_cast<std::uint8_t>(state ^ change)});
    }
    curve.states.push_back(blocks);
  }
  return curve;
}

}  // namespace

PeanoOptions parse_peano_options(const SpecText& spec) {
  spec.accept_only(lattice_keys({"gaps"}));
  return {parse_lattice_options(spec), parse_gap_move(spec)};
}

ToolPath peano_path(const HeightMap& map, const PeanoOptions& options, const Progress& progress) {
  return curve_path(map, options.lattice, peano_curve(), options.gaps, "peano", progress);
}

}  // namespace dwell
