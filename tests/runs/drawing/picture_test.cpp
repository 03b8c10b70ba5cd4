#include "runs/drawing/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "runs/drawing/colour_map.h"
#include "runs/drawing/map_figure.h"
#include "runs/drawing/plot_field.h"
#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Colour kPaper{255, 255, 255};

struct Middle {
  double x = 0.0;
  double y = 0.0;
  int count = 0;
};

// Where a field lies in a PNG file [pixels].
struct PixelPlace {
  int left = 0, top = 0, width = 0, height = 0;
};

PixelPlace pixels_of(const SheetBox& box) {
  const auto whole = [](double units) { return static_cast<int>(std::lround(kPixelsPerUnit * units)); };
  return {whole(box.left), whole(box.top), whole(box.width), whole(box.height)};
}

MapFigure figure_of(const PlotField& field, ColourMap map, const ColourLimits& limits, const std::string& title,
                    const std::string& unit, FigureFormat format = FigureFormat::Png) {
  return draw_maps(title, {{field, map, limits, "", unit}}, format);
}

// Mean position of the pixels of one colour [pixels of the figure, from the top left].
Middle middle_of(const testing::DecodedPng& png, Colour colour, const PixelPlace& place) {
  Middle m;
  for (int y = place.top; y < place.top + place.height; ++y) {
    for (int x = place.left; x < place.left + place.width; ++x) {
      if (!(png.at(x, y) == colour)) continue;
      m.x += x;
      m.y += y;
      ++m.count;
    }
  }
  m.x /= m.count;
  m.y /= m.count;
  return m;
}

HeightMap bumpy(Index rows, Index cols, Index row, Index col) {
  HeightMap map(Grid{rows, cols, 1.0, 1.0, {}});
  std::fill(map.values.begin(), map.values.end(), 0.0);
  map.at(row, col) = 1.0;
  return map;
}

ToolPath path_of(const std::vector<Point>& points) { return {"file", points, std::vector<char>(points.size(), 0)}; }

void expect_blank_margin(const testing::DecodedPng& png) {
  for (int x = 0; x < png.width; ++x) {
    for (const int y : {0, 5, png.height - 6, png.height - 1}) EXPECT_EQ(png.at(x, y), kPaper) << x << ", " << y;
  }
  for (int y = 0; y < png.height; ++y) {
    for (const int x : {0, 5, png.width - 6, png.width - 1}) EXPECT_EQ(png.at(x, y), kPaper) << x << ", " << y;
  }
}

TEST(MapPicture, ABumpAtPlusXPlusYIsRightAndUp) {
  const HeightMap map = bumpy(20, 40, 17, 35);
  const PictureOptions options{"a bump", "nm", true, -1.0, 1.0};
  const testing::DecodedPng png = testing::decode_png(map_picture(map, options));
  const PixelPlace p = pixels_of(figure_of(field_of_map(map), ColourMap::Diverging,
                                           colour_limits(map.values, ColourMap::Diverging, -1.0, 1.0), "a bump", "nm")
                                     .places[0]);
  const Middle m = middle_of(png, colour_at(ColourMap::Diverging, 1.0), p);
  ASSERT_EQ(m.count, (p.width / 40) * (p.width / 40)) << "one map pixel, enlarged by an integer";
  EXPECT_NEAR((m.x + 0.5 - p.left) / p.width, 35.5 / 40.0, 1e-9);
  EXPECT_NEAR((m.y + 0.5 - p.top) / p.height, 1.0 - 17.5 / 20.0, 1e-9);
}

TEST(MapPicture, VectorFormatsHoldTheWordsAndTheFieldAsAnImage) {
  const HeightMap map = bumpy(20, 40, 17, 35);
  const PictureOptions options{"Before: RMS 1 nm <b>", "nm", true, -1.0, 1.0};
  const std::string svg = map_picture(map, options, FigureFormat::Svg);
  EXPECT_EQ(svg.substr(0, 5), "<?xml");
  for (const char* words :
       {">Before: RMS 1 nm &lt;b&gt;<", ">x [mm]<", ">y [mm]<", ">nm<", "data:image/png;base64", ">30<"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
  const std::string pdf = map_picture(map, options, FigureFormat::Pdf);
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_NE(pdf.find("/Subtype /Image"), std::string::npos);
  EXPECT_NE(pdf.find("DejaVuSans"), std::string::npos) << "text with its font";
}

TEST(MapPicture, IsAtMost1600PixelsWide) {
  for (const auto& [rows, cols] :
       {std::pair<Index, Index>{10, 3000}, {3000, 10}, {2000, 1500}, {900, 1000}, {600, 1300}}) {
    HeightMap map(Grid{rows, cols, 0.1, 0.1, {-1e5, 1e5}},
                  std::vector<double>(static_cast<std::size_t>(rows * cols), -1e5));
    map.at(0, 0) = 1.0;
    EXPECT_LE(testing::decode_png(map_picture(map, {"title", "nm", true, {}, {}})).width, 1600)
        << rows << " x " << cols;
    EXPECT_LE(testing::decode_png(after_picture(map, map, FigureRange::Shared, "title")).width, 1600)
        << rows << " x " << cols;
  }
}

TEST(AfterPicture, ShowsTheRangeOfBeforeAndItsOwn) {
  HeightMap before = bumpy(20, 20, 10, 10), after = before;
  for (double& v : before.values) v *= 100.0;
  const auto strongest = [&](const std::string& file) {
    return middle_of(testing::decode_png(file), colour_at(ColourMap::Diverging, 1.0),
                     {0, 0, testing::decode_png(file).width, testing::decode_png(file).height});
  };
  const testing::DecodedPng shared = testing::decode_png(after_picture(before, after, FigureRange::Shared, "t"));
  const testing::DecodedPng own = testing::decode_png(after_picture(before, after, FigureRange::Own, "t"));
  EXPECT_GT(shared.width, 1200) << "two panels";
  // The bump is dark red in the second panel only; one such pixel of the first would pull the mean to the middle.
  EXPECT_GT(strongest(after_picture(before, after, FigureRange::Shared, "t")).x, 0.6 * shared.width);
  EXPECT_EQ(after_picture(before, after, FigureRange::Own, "t"), map_picture(after, {"t", "nm", true, {}, {}}));
  EXPECT_LT(own.width, shared.width + 1);
  const std::string svg = after_picture(before, after, FigureRange::Shared, "t", FigureFormat::Svg);
  EXPECT_NE(svg.find(">on the range of before<"), std::string::npos);
  EXPECT_NE(svg.find(">on its own range<"), std::string::npos);
}

TEST(MapPicture, SameNumbersSameBytes) {
  const HeightMap map = bumpy(9, 7, 2, 3);
  const PictureOptions options{"t", "nm", true, {}, {}};
  for (const FigureFormat format : figure_formats()) {
    EXPECT_EQ(map_picture(map, options, format), map_picture(map, options, format)) << to_string(format);
  }
  EXPECT_NE(map_picture(map, options), map_picture(bumpy(9, 7, 3, 3), options));
}

TEST(MapPicture, NothingReachesTheRim) {
  HeightMap wide(Grid{4, 300, 0.1, 0.1, {}});
  for (std::size_t i = 0; i < wide.values.size(); ++i)
    wide.values[i] = std::sin(0.1 * static_cast<double>(i)) * 123456.0;
  HeightMap tall(Grid{300, 4, 0.1, 0.1, {}}, wide.values);
  HeightMap single(Grid{1, 1, 2.5, 2.5, {}}, {-7.25});
  HeightMap nothing(Grid{3, 3, 1.0, 1.0, {}});
  HeightMap thin(Grid{1, 5000, 0.01, 0.01, {-1000.0, 2000.0}});
  const std::string long_title(150, 'W');
  for (const HeightMap* map : {&wide, &tall, &single, &nothing, &thin}) {
    for (const std::string& title : {std::string(), std::string("gypq"), long_title}) {
      expect_blank_margin(testing::decode_png(map_picture(*map, {title, "nm", true, {}, {}})));
      expect_blank_margin(testing::decode_png(map_picture(*map, {title, "nm/s", false, -10.0, 12.0})));
    }
  }
}

TEST(MapPicture, ShowsHolesInGreyAndSaysNoData) {
  HeightMap map = bumpy(10, 10, 5, 5);
  map.at(0, 0) = kNan;
  const PlotField field = field_of_map(map);
  EXPECT_TRUE(std::isnan(field.at(0, 0)));
  HeightMap nothing(map.grid);
  const MapFigure figure = figure_of(field_of_map(nothing), ColourMap::Diverging,
                                     colour_limits(nothing.values, ColourMap::Diverging), "", "nm");
  const testing::DecodedPng png = testing::decode_png(figure.bytes);
  const PixelPlace place = pixels_of(figure.places[0]);
  int grey = 0, ink = 0;
  for (int y = place.top; y < place.top + place.height; ++y) {
    for (int x = place.left; x < place.left + place.width; ++x) png.at(x, y) == kNoDataColour ? ++grey : ++ink;
  }
  EXPECT_GT(grey, 100 * 100);
  EXPECT_GT(ink, 200) << "the words on the plot";
}

TEST(MapPicture, RejectsColourLimitsThatAreNone) {
  EXPECT_THROW(map_picture(bumpy(2, 2, 0, 0), {"", "nm", false, 2.0, 1.0}), InputError);
}

TEST(FieldOfMap, KeepsTheAspectOfThePitches) {
  const PlotField field = field_of_map(HeightMap(Grid{30, 40, 0.5, 1.5, {10.0, 20.0}}));
  EXPECT_NEAR(static_cast<double>(field.cols) / field.rows, (40 * 0.5) / (30 * 1.5), 1.0 / field.cols);
  EXPECT_DOUBLE_EQ(field.left, 9.75);
  EXPECT_DOUBLE_EQ(field.right, 29.75);
  EXPECT_DOUBLE_EQ(field.bottom, 19.25);
  EXPECT_DOUBLE_EQ(field.top, 64.25);
}

TEST(FieldOfMap, AveragesLargeMapsOverFinitePixels) {
  HeightMap map(Grid{2040, 1020, 0.1, 0.1, {}});
  for (Index r = 0; r < 2040; ++r) {
    for (Index c = 0; c < 1020; ++c) map.at(r, c) = static_cast<double>(c % 3) + 3.0 * static_cast<double>(r % 3);
  }
  map.at(0, 0) = kNan;
  const PlotField field = field_of_map(map, {500, 680});
  ASSERT_EQ(field.rows, 680);
  ASSERT_EQ(field.cols, 340);
  EXPECT_DOUBLE_EQ(field.at(0, 0), 36.0 / 8.0);
  EXPECT_DOUBLE_EQ(field.at(679, 339), 4.0);
  EXPECT_DOUBLE_EQ(field.at(123, 321), 4.0);
}

TEST(FieldOfMap, KeepsASpeckOfDustThatAMeanWouldHide) {
  HeightMap map(Grid{2000, 2000, 0.1, 0.1, {}});
  for (Index r = 0; r < 2000; ++r) {
    for (Index c = 0; c < 2000; ++c)
      map.at(r, c) = 10.0 * std::sin(0.01 * static_cast<double>(r)) + 0.1 * static_cast<double>((r * 7 + c * 3) % 5);
  }
  map.at(1001, 1501) = 80.0;
  map.at(401, 301) = -80.0;
  const PlotField field = field_of_map(map, {500, 500});
  EXPECT_EQ(*std::max_element(field.values.begin(), field.values.end()), 80.0);
  EXPECT_EQ(*std::min_element(field.values.begin(), field.values.end()), -80.0);
  EXPECT_EQ(field.at(250, 375), 80.0);
  EXPECT_EQ(field.at(100, 75), -80.0);
  std::size_t shown = 0;
  for (const double v : field.values) shown += std::abs(v) > 11.0;
  EXPECT_EQ(shown, 2u) << "noise and slopes stay means";
}

TEST(FieldOfMap, CanBeInterrupted) {
  Progress stop;
  stop.stop = [] { return true; };
  EXPECT_THROW(field_of_map(bumpy(10, 10, 1, 1), {}, stop), Interrupted);
}

TEST(FieldOfDwell, CoversARasterWithoutHoles) {
  std::vector<Point> points;
  std::vector<double> dwell;
  for (const double angle : {0.0, 0.4}) {
    points.clear();
    dwell.clear();
    for (int j = 0; j < 21; ++j) {
      for (int i = 0; i < 81; ++i) {
        const Point p{0.25 * i, 1.0 * j};  // step 0.25 mm, pitch 1 mm: squares of the step would leave stripes
        points.push_back(
            {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y});
        dwell.push_back(p.x);
      }
    }
    const PlotField field = field_of_dwell(path_of(points), dwell);
    const double scale = field.cols / (field.right - field.left);
    int checked = 0;
    for (int r = 0; r < field.rows; ++r) {
      for (int c = 0; c < field.cols; ++c) {
        const double x = field.left + (c + 0.5) / scale;
        const double y = field.bottom + (r + 0.5) / scale;
        const double u = std::cos(angle) * x + std::sin(angle) * y;
        const double v = -std::sin(angle) * x + std::cos(angle) * y;
        if (u < 0.0 || u > 20.0 || v < 0.0 || v > 20.0) continue;
        ++checked;
        // The nearest point is within half a step along the line; a pixel or two for rounding to pixels.
        ASSERT_LE(std::abs(field.at(r, c) - u), 0.125 + 2.0 / scale) << x << ", " << y;
      }
    }
    EXPECT_GT(checked, 100000);
  }
}

TEST(FieldOfDwell, ShowsOnePointTwoPointsAndCoincidentOnes) {
  const PlotField one = field_of_dwell(path_of({{3.0, 4.0}}), {2.5});
  EXPECT_DOUBLE_EQ(one.at(one.rows / 2, one.cols / 2), 2.5);
  EXPECT_NEAR(0.5 * (one.left + one.right), 3.0, 1e-9);
  EXPECT_NEAR(one.right - one.left, 1.0, 0.02);

  const PlotField two = field_of_dwell(path_of({{0.0, 0.0}, {10.0, 0.0}}), {1.0, 2.0});
  EXPECT_DOUBLE_EQ(two.at(two.rows / 2, 0), 1.0);
  EXPECT_DOUBLE_EQ(two.at(two.rows / 2, two.cols - 1), 2.0);

  const PlotField mean = field_of_dwell(path_of({{0.0, 0.0}, {0.0, 0.0}}), {1.0, 2.0});
  EXPECT_DOUBLE_EQ(mean.at(0, 0), 1.5);
}

TEST(FieldOfDwell, LeavesOutWhatIsFarFromEveryPoint) {
  std::vector<Point> points;
  for (int j = 0; j < 10; ++j) {
    for (int i = 0; i < 10; ++i) points.push_back({1.0 * i + (j < 5 ? 0.0 : 40.0), 1.0 * j});
  }
  const PlotField field = field_of_dwell(path_of(points), std::vector<double>(points.size(), 1.0));
  const double scale = field.cols / (field.right - field.left);
  const auto value_at = [&](double x, double y) {
    return field.at(static_cast<int>((y - field.bottom) * scale), static_cast<int>((x - field.left) * scale));
  };
  EXPECT_TRUE(std::isnan(value_at(25.0, 5.0))) << "a lifted move from one part to the other is not drawn";
  EXPECT_EQ(value_at(4.5, 2.5), 1.0);
  EXPECT_EQ(value_at(44.5, 7.5), 1.0);
}

TEST(DwellPicture, PaintsALongDwellWhereItIs) {
  std::vector<Point> points;
  std::vector<double> dwell;
  for (int j = 0; j < 30; ++j) {
    for (int i = 0; i < 30; ++i) {
      points.push_back({1.0 * i, 1.0 * j});
      dwell.push_back(i >= 24 && j >= 24 ? 2.0 : 1.0);
    }
  }
  const testing::DecodedPng png =
      testing::decode_png(dwell_picture(path_of(points), dwell, {"dwell", "", false, {}, {}}));
  const PixelPlace p = pixels_of(figure_of(field_of_dwell(path_of(points), dwell), ColourMap::Sequential,
                                           colour_limits(dwell, ColourMap::Sequential), "dwell", "s")
                                     .places[0]);
  const Middle m = middle_of(png, colour_at(ColourMap::Sequential, 1.0), p);
  EXPECT_NEAR((m.x - p.left) / p.width, 0.9, 0.01);
  EXPECT_NEAR((m.y - p.top) / p.height, 0.1, 0.01);
}

TEST(DwellPicture, RejectsAPathOfAnotherSizeAndShowsDwellWithoutValues) {
  EXPECT_THROW(dwell_picture(path_of({{0.0, 0.0}, {1.0, 0.0}}), {1.0}, {}), InputError);
  EXPECT_THROW(dwell_picture(path_of({}), {}, {}), InputError);
  EXPECT_THROW(dwell_picture(path_of({{kNan, 0.0}}), {1.0}, {}), InputError);
  const testing::DecodedPng png = testing::decode_png(dwell_picture(path_of({{0.0, 0.0}}), {kNan}, {}));
  EXPECT_EQ(png.at(png.width / 2, png.height / 3), kNoDataColour);
}

}  // namespace
}  // namespace dwell
