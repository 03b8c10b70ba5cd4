#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/tool_path.h"
#include "core/removal/removal_operator.h"
#include "core/tif/removal_function.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// The mean of a removal function over a map's pixels as a function of the displacement, tabulated as a spline so fine
/// that it is right to kError of its RMS, or that it has kMostNodes nodes. Made once for a part, used by every probe.
struct PixelMeanTable {
  static constexpr double kError = 1e-4, kMostNodes = 3e5;

  SplineSurface mean;                  // [nm/s], by displacement from the tool axis
  std::function<double(Point)> point;  // the rate at a point
  double panel = 0.0;                  // longest stretch of a stroke for which two Gauss points do as well [mm]
};

/// Cost: the means over a pixel at all nodes, under a second.
PixelMeanTable tabulate_pixel_mean(const RemovalFunction& tif, const Grid& map);

/// What a program removes at single places, from the removal function itself: the reference by which the lattice of the
/// removal operators is judged (docs/math.md, "The exact figure"). It shares no lattice with them: every stroke is
/// replaced by Gauss points, and at each of these the table gives what the tool removes.
class RemovalProbe {
 public:
  /// strokes and the seconds that the tool takes for each. The table must outlive the probe. Throws
  /// std::invalid_argument if their numbers differ. Cost and memory: 24 bytes for two to four Gauss points a stroke,
  /// more where strokes are longer than a panel of the table. Strokes out of reach of the map cost nothing.
  RemovalProbe(const Grid& map, const PixelMeanTable& table, const std::vector<Stroke>& strokes,
               std::span<const double> seconds);

  /// The mean removal [nm] over the area of a pixel about `centre` [mm]. Cost: 10 ns for every Gauss point under the
  /// tool.
  double mean_over_pixel(Point centre) const;
  /// The removal [nm] at a point [mm], by the spline or formula of the removal function. Cost as above, three times.
  double at(Point point) const;

  /// The Gauss points that a call takes on average, to know the cost beforehand.
  double points_under_tool() const;

 private:
  /// A place of the tool and the seconds that it counts there.
  struct Visit {
    Point position;
    double seconds;
  };
  void add_visit(Point p, double seconds, std::vector<Visit>& visits) const;
  void add_leg(Point from, Point to, double seconds, std::vector<Visit>& visits) const;
  void sort_into_cells(const std::vector<Visit>& visits);
  template <class Take>
  void for_visits(Point centre, const Take& take) const;

  Grid map_;
  const PixelMeanTable& table_;
  Point low_, high_;                // displacements within which there is removal [mm]
  Grid cells_;                      // origin: the corner of the first cell
  std::vector<std::size_t> begin_;  // of each cell's visits, and the end
  std::vector<Visit> visits_;       // cell by cell
};

/// The mean removal [nm] over each of these pixels of the map (linear indices), by a probe. `progress` shows the share
/// done; Throws Interrupted. The same bytes for any number of threads.
Vector mean_removal(const RemovalProbe& probe, const Grid& map, const std::vector<Index>& pixels, int threads,
                    const Progress& progress = {});

}  // namespace dwell
