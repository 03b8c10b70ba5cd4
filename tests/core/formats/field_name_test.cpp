#include "core/formats/field_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dwell {
namespace {

TEST(FieldName, KnowsATopicInManySpellings) {
  const auto expect = [](MapTopic topic, const std::vector<std::string>& names) {
    for (const std::string& name : names) EXPECT_EQ(parse_field_name(name).topic, topic) << name;
  };
  expect(MapTopic::ValueUnit, {"unit", "Units", "z_unit", "z unit", "zUnits", "ZUNIT", "BUNIT", "Height units",
                               "value_units", "DataUnit", "opd_unit", "rate unit", "unit_z"});
  expect(MapTopic::LateralUnit, {"xy_unit", "PIXUNIT", "pitch_unit", "pixel size unit", "lateral_units", "XUnit"});
  expect(MapTopic::UnknownUnit, {"laser_unit", "gizmo units"});
  expect(MapTopic::Other, {"exposure_time_unit", "TEMPERATURE_UNIT", "wavelength", "operator", "community", "x", "y",
                           "serial", "date", "count", "", "__"});
  expect(MapTopic::Pitch, {"pitch_mm", "pixel_size_um", "Pixel size",       "PixelSizeX",   "dx",
                           "dY",       "dx_mm",         "spacing",          "mm_per_pixel", "xpix",
                           "XPIXSZ",   "PIXSIZE1",      "PUPLSCAL",         "PITCHMM",      "lateral_resolution",
                           "x_step",   "DIFFELEM",      "pixel pitch [um]", "x_scale",      "pixels_per_mm"});
  expect(MapTopic::Size, {"width_mm", "XReal", "size", "diameter", "field_of_view"});
  expect(MapTopic::Origin, {"origin_mm", "Origin", "x_offset", "xmin", "X0", "y_start", "XORGSUBF", "originX_mm"});
  expect(MapTopic::NoData, {"no_data", "NODATA", "fill_value", "missing", "bad value", "InvalidValue"});
  expect(MapTopic::ValueScale, {"z_scale", "offset", "slope", "scale", "ZFactor"});
  expect(MapTopic::ValueScale, {"counts_to_nm", "dn2nm", "nm_per_volt", "exponent", "prefix", "sign", "normalized"});
  expect(MapTopic::Orientation, {"flipud", "y_axis", "rotation_deg", "view", "FLIPY", "handedness", "transform"});
  expect(MapTopic::AxisOrder, {"dims", "axes", "DIMENSION_LABELS", "axis_order", "order"});
  expect(MapTopic::Other, {"mm_per_min", "filter_order", "spindle_rotation_rpm", "scale_bar", "tilt_x"});
  expect(MapTopic::Label, {"long_name", "label"});
  EXPECT_TRUE(parse_field_name("x_mm").place && parse_field_name("Y").place);
  EXPECT_FALSE(parse_field_name("x_slope").place || parse_field_name("map").place);
}

TEST(FieldName, FindsTheAxisAndTheUnit) {
  struct Case {
    std::string name;
    FieldAxis axis;
    std::optional<double> mm;
    bool clear;
  };
  for (const Case& c :
       {Case{"pitch_mm", FieldAxis::Both, 1.0, true}, Case{"pixel_size_um", FieldAxis::Both, 1e-3, true},
        Case{"PixelSizeX", FieldAxis::X, {}, true}, Case{"dy_m", FieldAxis::Y, 1e3, true},
        Case{"Pixel size (\xc2\xb5m)", FieldAxis::Both, 1e-3, true}, Case{"um_per_pixel", FieldAxis::Both, 1e-3, true},
        Case{"pixels_per_mm", FieldAxis::Both, {}, false}, Case{"lateral_resolution_um", FieldAxis::Both, 1e-3, false},
        Case{"camera_pixel_size_um", FieldAxis::Both, 1e-3, false}, Case{"pixel_width_mm", FieldAxis::X, 1.0, true},
        Case{"origin_y_mm", FieldAxis::Y, 1.0, true}, Case{"xmin_mm", FieldAxis::X, 1.0, false},
        Case{"PITCHMM", FieldAxis::Both, 1.0, true}, Case{"zoom_in", FieldAxis::Both, {}, false}}) {
    const FieldName name = parse_field_name(c.name);
    EXPECT_EQ(name.axis, c.axis) << c.name;
    EXPECT_EQ(name.mm.has_value(), c.mm.has_value()) << c.name;
    EXPECT_NEAR(name.mm.value_or(0.0), c.mm.value_or(0.0), 1e-12 * c.mm.value_or(0.0)) << c.name;
    EXPECT_EQ(name.clear, c.clear) << c.name;
  }
}

}  // namespace
}  // namespace dwell
