#include "paths/lattice/hilbert.h"

namespace dwell {
namespace {

/// State bits: 1 = mirrored about the rising diagonal, 2 = turned by half a turn.
FillingCurve hilbert_curve() {
  FillingCurve curve{2, {}};
  for (unsigned state = 0; state < 4; ++state) {
    // Up, right, down: the first quarter mirrored, the last one mirrored and turned.
    const unsigned order[4][3] = {{0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 3}};
    std::vector<FillingCurve::Block> blocks;
    for (const auto& [row, col, change] : order) {
      const unsigned turn = state >> 1;
      const unsigned r = (state & 1U) != 0 ? col : row, c = (state & 1U) != 0 ? row : col;
      blocks.push_back({static_cast<std::uint8_t>(r ^ turn), static_cast<std::uint8_t>(c ^ turn),
                        static_cast<std::uint8_t>(state ^ change)});
    }
    curve.states.push_back(blocks);
  }
  return curve;
}

}  // namespace

HilbertOptions parse_hilbert_options(const SpecText& spec) {
  spec.accept_only(lattice_keys({"gaps"}));
  return {parse_lattice_options(spec), parse_gap_move(spec)};
}

ToolPath hilbert_path(const HeightMap& map, const HilbertOptions& options, const Progress& progress) {
  return curve_path(map, options.lattice, hilbert_curve(), options.gaps, "hilbert", progress);
}

}  // namespace dwell
