#include "runs/base/json_blocks.h"

#include <gtest/gtest.h>

#include <limits>

namespace dwell {
namespace {

using nlohmann::json;

TEST(JsonBlocks, BeginWithTheLayoutAndTheCommand) {
  const json head = json_of_command("map");
  EXPECT_EQ(head["schema"], 2);
  EXPECT_EQ(head["command"], "map");
  EXPECT_TRUE(head["version"].is_string());
}

TEST(JsonBlocks, HaveNullWhereThereIsNoNumber) {
  EXPECT_TRUE(finite_or_null(std::nan("")).is_null());
  EXPECT_TRUE(finite_or_null(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_TRUE(finite_or_null(std::optional<double>()).is_null());
  EXPECT_EQ(finite_or_null(std::optional<double>(1.5)), 1.5);
}

TEST(JsonBlocks, TellTheWholeMapAndWhatTheApertureLeaves) {
  const MapFigures map{"a.csv",      Grid{2, 3, 0.5, 0.25, {-1.0, 2.0}}, {"crop"}, 6, "rect:0,0,1,1", "piston",
                       {4, 7.0, 2.0}};
  const json block = map_block(map);
  EXPECT_EQ(block["rows"], 2);
  EXPECT_EQ(block["columns"], 3);
  EXPECT_EQ(block["pixel_mm"], json({0.5, 0.25}));
  EXPECT_EQ(block["origin_mm"], json({-1.0, 2.0}));
  EXPECT_EQ(block["valid_pixels"], 6);
  EXPECT_EQ(block["aperture_pixels"], 4);
  EXPECT_EQ(block["pv_nm"], 7.0);
  EXPECT_EQ(block["rms_nm"], 2.0);
  // A map's grid has the keys of any grid.
  const json grid = grid_block(map.grid);
  for (const auto& [key, value] : grid.items()) EXPECT_EQ(block[key], value) << key;
}

TEST(JsonBlocks, TellTheCorrectionOfTheKernelOnlyWhereThereIsOne) {
  const RemovalFunction tif = gaussian_removal(2.0, 3.0, 4.0);
  EXPECT_FALSE(tif_block(tif, "gaussian", {}).contains("volume_factor"));
  EXPECT_EQ(tif_block(tif, "gaussian", {}, 1.25)["volume_factor"], 1.25);
  EXPECT_EQ(tif_block(tif, "spot", {})["kind"], "spot");
}

TEST(JsonBlocks, TellAProgramByItsSteps) {
  Program program{"a.nc", {{{0.0, 0.0}, {3.0, 4.0}, 2.0, true}, {{3.0, 4.0}, {0.0, 0.0}, 1.0, false}}};
  ExactResidual residual;
  residual.statistics = {10, 5.0, 1.5, -3.0};
  residual.standard_error = 0.25;
  residual.ripple = 4.0;
  residual.lattice_error = 0.125;
  residual.checked = 7;
  const json block = program_block(program_figures(program, residual, "tilt"));
  EXPECT_EQ(block["file"], "a.nc");
  EXPECT_EQ(block["steps"], 2);
  EXPECT_EQ(block["removing_length_mm"], 5.0);
  EXPECT_EQ(block["total_s"], 3.0);
  EXPECT_EQ(block["residual_rms_nm"], 1.5);
  EXPECT_EQ(block["residual_pv_nm"], 5.0);
  EXPECT_EQ(block["residual_mean_nm"], -3.0);
  EXPECT_EQ(block["residual_rms_standard_error_nm"], 0.25);
  EXPECT_EQ(block["ripple_within_pixels_rms_nm"], 4.0);
  EXPECT_DOUBLE_EQ(block["total_rms_nm"], std::sqrt(1.5 * 1.5 + 3.0 * 3.0 + 4.0 * 4.0));
  EXPECT_EQ(block["pixels_checked"], 7);
  EXPECT_EQ(block["lattice_error_rms_nm"], 0.125);
  EXPECT_EQ(block["removed"], "tilt");
  EXPECT_TRUE(block["notes"].empty());
}

TEST(JsonBlocks, EscapesBytesThatAreNoUtf8) {
  json block{{"file", "m\xE9tal.csv"}, {"list", {"h\xC3\xB6he", "\xFF"}}};
  EXPECT_EQ(json::parse(json_text(block)), (json{{"file", "m\\xE9tal.csv"}, {"list", {"h\xC3\xB6he", "\\xFF"}}}));
}

}  // namespace
}  // namespace dwell
