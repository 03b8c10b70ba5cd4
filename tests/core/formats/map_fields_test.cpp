#include "core/formats/map_fields.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

MapField number(const std::string& name, const std::vector<double>& numbers) {
  return {name, numbers, {}, "field " + name, {}};
}
MapField logical(const std::string& name, bool value) {
  return {name, {value ? 1.0 : 0.0}, {}, "field " + name, {}, true};
}
MapField text(const std::string& name, const std::string& value) { return {name, {}, {value}, "field " + name, {}}; }

SaidOfMap said(const std::vector<MapField>& fields) { return read_map_fields(fields, "map a"); }

void refused(const std::vector<MapField>& fields, std::initializer_list<std::string> words) {
  test::expect_input_error([&] { said(fields); }, words);
}

TEST(MapFields, TakeAUnitUnderItsManyNames) {
  for (const char* name : {"unit", "units", "z_unit", "Height units", "BUNIT"}) {
    EXPECT_EQ(said({text(name, " um ")}).header.unit, "um") << name;
  }
  EXPECT_EQ(said({text("long_name", "height [um]")}).header.unit, "um");
  EXPECT_FALSE(said({text("long_name", "height [of the part]")}).header.unit);
  EXPECT_FALSE(said({text("unit", "")}).header.unit);
  EXPECT_EQ(said({text("unit", "um"), text("z_unit", "micrometers")}).header.unit, "um");
  refused({text("unit", "um"), text("z_unit", "nm")}, {"map a", "field unit = 'um'", "field z_unit = 'nm'", "agree"});
  refused({number("unit", {3})}, {"field unit = 3", "a text"});
}

TEST(MapFields, RefuseAUnitOfNobodyKnowsWhat) {
  refused({text("gizmo_unit", "um")}, {"field gizmo_unit = 'um'", "unit of the heights"});
  EXPECT_FALSE(said({text("gizmo_unit", "ms")}).header.unit) << "no height is in milliseconds";
  EXPECT_EQ(said({text("gizmo_unit", "mm"), text("unit", "nm")}).header.unit, "nm");
}

TEST(MapFields, TakeAPitchWhereItsUnitIsSaid) {
  EXPECT_EQ(said({number("pitch_mm", {0.5, 0.25})}).header.pitch, (Point{0.5, 0.25}));
  EXPECT_EQ(said({number("pixel_size", {0.5}), text("xy_unit", "mm")}).header.pitch, (Point{0.5, 0.5}));
  EXPECT_EQ(said({number("dx_mm", {0.5}), number("dy_mm", {0.25})}).header.pitch, (Point{0.5, 0.25}));
  EXPECT_EQ(said({text("spacing", "0.5 mm")}).header.pitch, (Point{0.5, 0.5}));
  EXPECT_EQ(said({number("um_per_pixel", {500}), number("pitch_mm", {0.5})}).header.pitch, (Point{0.5, 0.5}));
  EXPECT_NEAR(said({number("pixel_size_m", {5e-4})}).header.pitch->x, 0.5, 1e-15);
  EXPECT_NE(said({number("pixel_size_um", {500})}).pitch_field.find("pixel_size_um = 500"), std::string::npos);
}

TEST(MapFields, LeaveOpenWhatMayBeAnotherPitch) {
  const auto unclear = [](const std::vector<MapField>& fields) {
    const SaidOfMap result = said(fields);
    EXPECT_FALSE(result.header.pitch);
    return result.unclear_pitch;
  };
  EXPECT_EQ(unclear({number("pixel_size", {0.5})}), "field pixel_size = 0.5") << "of which unit?";
  EXPECT_EQ(unclear({number("pixel_size_mm", {0.5, 0.25})}), "field pixel_size_mm = 0.5, 0.25") << "x first, or y?";
  EXPECT_EQ(unclear({number("dx_mm", {0.5})}), "field dx_mm = 0.5") << "and y?";
  EXPECT_NE(unclear({number("lateral_resolution_um", {3})}), "");
  EXPECT_NE(unclear({number("camera_pixel_size_um", {3.45})}), "");
  EXPECT_NE(unclear({number("width_mm", {30})}), "");
  EXPECT_EQ(unclear({number("serial", {30})}), "");
}

TEST(MapFields, RefuseAPitchThatIsNone) {
  refused({number("pitch_mm", {-0.5})}, {"pitch_mm = -0.5", "> 0"});
  refused({text("pitch_mm", "0.5")}, {"pitch_mm = '0.5'", "finite number > 0"});
  refused({number("pixel_size_um", {0})}, {"pixel_size_um = 0", "> 0"});
  refused({number("pitch_mm", {0.5}), number("pixel_size_um", {400})},
          {"pitch_mm = 0.5", "pixel_size_um = 400", "agree"});
}

TEST(MapFields, TakeAnOriginOrSayThatItIsUnclear) {
  EXPECT_EQ(said({number("origin_mm", {-1.5, 2})}).header.origin, (Point{-1.5, 2.0}));
  EXPECT_EQ(said({number("x_origin_um", {500}), number("y_origin_um", {-250})}).header.origin, (Point{0.5, -0.25}));
  for (const MapField& field : {number("origin", {-1.5, 2}), number("x_offset_mm", {3}), number("x_origin_mm", {3}),
                                text("origin", "upper left"), number("xmin", {1})}) {
    const SaidOfMap result = said({field});
    EXPECT_FALSE(result.header.origin) << field.name;
    EXPECT_NE(result.unclear_origin.find(field.name), std::string::npos) << field.name;
  }
  EXPECT_EQ(said({number("x_offset", {0}), text("origin", "a shop in Jena")}).unclear_origin, "");
  refused({number("origin_mm", {1, NAN})}, {"origin_mm", "two finite"});
}

TEST(MapFields, TakeMarkersOfNoDataAndRefuseFactors) {
  EXPECT_EQ(said({number("no_data", {-9999}), text("missing", "nan")}).header.no_data, (std::vector<double>{-9999}));
  refused({text("no_data", "grey")}, {"no_data = 'grey'", "a number"});
  refused({number("z_scale", {1e-3})}, {"z_scale = 0.001", "1 (heights as they are)"});
  refused({number("offset", {5})}, {"offset = 5", "0 (heights"});
  EXPECT_TRUE(said({number("scale", {1}), number("offset", {0})}).header.no_data.empty());
}

TEST(MapFields, TakeAUnitUnderANameOfTheValues) {
  for (const MapField& field :
       {text("z", "um"), text("height", "um"), text("quantity", "um"), text("quantity", "height [um]"),
        text("surface", "um"), text("H\xc3\xb6he", "um"), text("Einheit", "um")}) {
    EXPECT_EQ(said({field}).header.unit, "um") << field.name;
    EXPECT_TRUE(said({field}).header.unclear.empty()) << field.name;
    EXPECT_EQ(said({field}).unclear_pitch, "") << field.name;
  }
  EXPECT_FALSE(said({text("quantity", "height")}).header.unit);
}

TEST(MapFields, KeepWhatTextsAndDoubtfulNamesMaySay) {
  using About = UnclearStatement::About;
  const auto expect = [](const MapField& field, About about) {
    const MapHeader header = said({field}).header;
    ASSERT_FALSE(header.unclear.empty()) << field.name;
    EXPECT_EQ(header.unclear[0].about, about) << field.name;
    EXPECT_NE(header.unclear[0].message.find("map a: field " + field.name), std::string::npos)
        << header.unclear[0].message;
  };
  expect(text("columns", "x_mm y_mm z_um"), About::Unit);
  expect(text("comment", "heights in um"), About::Unit);
  expect(text("detector", "um"), About::Unit);
  expect(text("height", "given in um"), About::Unit);
  expect(number("conversion", {0.5}), About::Factor);
  expect(number("gain", {2}), About::Factor);
  expect(number("waves", {1}), About::Factor);
  expect(text("orientation", "top-down"), About::Rows);
  expect(number("flipped", {1}), About::Rows);
  for (const MapField& field : {text("orientation", "none"), number("flipped", {0}), text("comment", "made by Anna"),
                                text("instrument", "Verifire, 633 nm"), number("gain", {1}), number("waves", {0})}) {
    EXPECT_TRUE(said({field}).header.unclear.empty()) << field.name;
  }
  for (const MapField& field : {number("center_mm", {50, 50}), number("center_mm", {0, 0}),
                                number("extent_mm", {0, 9, 0, 8}), number("Mittelpunkt", {1, 2})}) {
    EXPECT_NE(said({field}).unclear_origin.find(field.name), std::string::npos) << field.name;
  }
}

// What says the same as this program does is no question, whatever it is called.
TEST(MapFields, AskWhichWayTheMapLiesAndWhatItsNumbersAre) {
  using About = UnclearStatement::About;
  const auto asked = [](const MapField& field) -> std::optional<About> {
    const MapHeader header = said({field}).header;
    return header.unclear.empty() ? std::nullopt : std::optional(header.unclear[0].about);
  };
  const MapField labels{"DIMENSION_LABELS", {}, {"x", "y"}, "field DIMENSION_LABELS", {}};
  for (const MapField& field : {labels,
                                text("dims", "x,y"),
                                text("dims", "lon, lat"),
                                text("axes", "xy"),
                                number("axes", {1, 0}),
                                text("order", "F"),
                                text("y_axis", "down"),
                                number("y_axis", {-1}),
                                number("x_sign", {-1}),
                                number("FLIPY", {1}),
                                number("flipud", {1}),
                                number("rotation_deg", {90}),
                                text("view", "from the back"),
                                text("mirror", "x"),
                                text("transform", "rot90"),
                                text("handedness", "left"),
                                text("first_axis", "x"),
                                text("rows", "x"),
                                number("y_down", {1}),
                                text("columns", "y"),
                                text("y_up", "false"),
                                logical("y_up", false),
                                logical("grid.yAxisDown", true),
                                text("x_right", "no"),
                                logical("x_axis_left", true),
                                number("angle_deg", {15}),
                                text("layout", "array is [x, y]"),
                                text("origin", "upper")}) {
    EXPECT_EQ(asked(field), About::Rows) << field.name;
  }
  for (const MapField& field :
       {number("exponent", {-6}), text("prefix", "micro"), number("sign", {-1}), text("z_sign", "negative"),
        number("fringe_nm", {316}), number("counts_to_nm", {0.25}), number("normalized", {1}), number("divisor", {10}),
        number("to_nm", {0.3}), number("mult", {2}), number("magnitude", {-6}), text("z_up", "false"),
        logical("z_up", false), text("note", "x 1e-6 m"), text("height", "10 nm")}) {
    EXPECT_EQ(asked(field), About::Factor) << field.name;
  }
  for (const MapField& field : {number("mask", {9}), number("background", {9}), number("bad", {7})}) {
    EXPECT_EQ(asked(field), About::NoData) << field.name;
  }
  const MapField usual_labels{"dims", {}, {"y", "x"}, "field dims", {}};
  MapField masked = number("masked", {1});
  masked.logical = true;
  for (const MapField& field : {usual_labels,
                                masked,
                                text("dims", "('y', 'x')"),
                                text("axes", "row, column"),
                                number("axes", {0, 1}),
                                text("order", "C"),
                                text("order", "zernike"),
                                text("rows", "y"),
                                number("rows", {9}),
                                number("order", {4}),
                                text("y_axis", "up"),
                                number("y_axis", {1}),
                                text("columns", "x"),
                                text("y_up", "true"),
                                logical("y_up", true),
                                logical("y_down", false),
                                logical("x_right", true),
                                text("z_up", "yes"),
                                number("angle_deg", {0}),
                                text("ROWORDER", "BOTTOM-UP"),
                                text("origin", "lower"),
                                text("origin", "lower left"),
                                number("flipud", {0}),
                                number("rotation_deg", {0}),
                                text("view", "front"),
                                text("mirror", "M1"),
                                text("transform", "identity"),
                                number("exponent", {0}),
                                text("prefix", "run7_"),
                                text("sign", "+"),
                                number("sign", {1}),
                                number("normalized", {0}),
                                text("x_label", "x [mm]"),
                                text("unit", "micrometre (um)")}) {
    EXPECT_FALSE(asked(field)) << field.name;
    EXPECT_EQ(said({field}).unclear_origin, "") << field.name;
  }
  EXPECT_FALSE(said({text("x_label", "x [mm]")}).header.unit) << "that of x";
  for (const MapField& field :
       {number("x_mm", {10}), number("x", {0, 1, 2}), number("ref_pixel", {5, 6}), number("x_range", {-25, 25}),
        number("xc", {3}), number("origin_px", {6, 5}), number("left_mm", {-3}), number("y_axis", {0, 1, 2})}) {
    EXPECT_NE(said({field}).unclear_origin, "") << field.name;
  }
  for (const MapField& field : {number("x_mm", {0}), number("x_range", {0, 25}), number("ref_pixel", {0, 0})}) {
    EXPECT_EQ(said({field}).unclear_origin, "") << field.name;
  }
}

TEST(MapFields, KnowALengthAsText) {
  EXPECT_NEAR(length_of_text("632.8 nm").value(), 632.8e-6, 1e-15);
  EXPECT_EQ(length_of_text("0.12mm"), 0.12);
  for (const char* none : {"", "mm", "0.12", "0.12 s", "about 3 mm"}) EXPECT_FALSE(length_of_text(none)) << none;
}

}  // namespace
}  // namespace dwell
