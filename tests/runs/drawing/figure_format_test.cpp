#include "runs/drawing/figure_format.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

TEST(FigureFormats, AreReadFromListsAndFileNames) {
  using Formats = std::vector<FigureFormat>;
  EXPECT_EQ(parse_figure_formats("png"), (Formats{FigureFormat::Png}));
  EXPECT_EQ(parse_figure_formats("svg, png,svg"), (Formats{FigureFormat::Svg, FigureFormat::Png}));
  EXPECT_EQ(figure_format_of_file("a/b.c/x.PDF"), FigureFormat::Pdf);
  for (const FigureFormat format : figure_formats()) {
    EXPECT_EQ(figure_format_of_file("x." + std::string(to_string(format))), format);
  }
}

TEST(FigureFormats, RefuseOthersByName) {
  for (const char* text : {"", "jpg", "png,", "PNG"}) {
    test::expect_input_error([&] { parse_figure_formats(text); }, {text, "accepted: png, svg, pdf"});
  }
  for (const char* name : {"", "png", "x.jpg", ".svg/x"}) {
    test::expect_input_error([&] { figure_format_of_file(name); }, {name, "accepted: .png, .svg, .pdf"});
  }
  EXPECT_EQ(parse_figure_range("shared"), FigureRange::Shared);
  EXPECT_EQ(parse_figure_range("own"), FigureRange::Own);
  test::expect_input_error([] { parse_figure_range("both"); }, {"both", "shared, own"});
}

}  // namespace
}  // namespace dwell
