#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runs/drawing/colour_map.h"
#include "runs/drawing/plot_field.h"
#include "runs/drawing/sheet.h"

namespace dwell {

/// What a colour on top of a field means.
struct PanelKey {
  Colour colour;
  std::string label;
  bool is_text = false;  // a line of words alone
};

/// One field of a figure.
struct MapPanel {
  PlotField field;
  ColourMap colours = ColourMap::Sequential;
  ColourLimits limits;
  std::string title;  // above the field; empty: none
  std::string unit;   // of the values
  /// Draws on top of the field. It gets the field's place on the sheet; nothing shows outside of that.
  std::function<void(Sheet&, const SheetBox&)> over{};
  std::vector<PanelKey> key{};  // below the field, in the place of the colour bar
};

struct MapFigure {
  std::string bytes;
  std::vector<SheetBox> places;  // of the fields [units], a panel each
};

/// Fields in colour, framed, with axes in mm (+x right, +y up), titles, and colour bars with their unit: at the right,
/// or below a field at least twice as wide as high. Panels stand side by side as far as the widest sheet has room.
/// Where the limits cut values off, the bar ends in an arrow and says how far the values go. A field without values
/// says "no data" and has no bar; one with a key has its lines below and no bar.
MapFigure draw_maps(const std::string& title, const std::vector<MapPanel>& panels, FigureFormat format);

/// How large the fields of a figure with so many panels may be.
FieldEdges field_edges(std::size_t panels);

}  // namespace dwell
