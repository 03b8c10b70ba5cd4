#include "core/formats/hdf5_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/hdf5_file.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/formats/byte_flips.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

using test::Hdf5TestFile;

MapSource read_hdf5(const std::string& bytes) { return parse_hdf5(bytes, "map a.h5"); }

const std::vector<double> kSixValues{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};

TEST(Hdf5Map, ReadsTheOnlyMatrixWithItsAttributes) {
  Hdf5TestFile file;
  file.doubles("/run/before", {2, 3}, kSixValues);
  file.doubles("/run/x", {3}, {1, 2, 3});  // not a matrix
  file.number("/run/before", "pitch_mm", {0.5, 0.25});
  file.number("/run/before", "origin_mm", {-1.5, 2.0});
  file.text("/run/before", "unit", "um", true);
  file.text("/run/before", "history", "read a\nand b");
  const MapSource source = read_hdf5(file.bytes());
  EXPECT_EQ(source.rows, 2);
  EXPECT_EQ(source.cols, 3);
  EXPECT_EQ(source.values, kSixValues);
  EXPECT_EQ(source.header.pitch, (Point{0.5, 0.25}));
  EXPECT_EQ(source.header.origin, (Point{-1.5, 2.0}));
  EXPECT_EQ(source.header.unit, "um");
  EXPECT_EQ(source.header.history, (std::vector<std::string>{"read a and b"}));
}

TEST(Hdf5Map, ReadsIntegersChunksAndFilters) {
  const hid_t packed = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t chunk[2] = {1, 2};
  H5Pset_chunk(packed, 2, chunk);
  H5Pset_shuffle(packed);
  H5Pset_deflate(packed, 6);
  Hdf5TestFile file;
  const std::vector<int> integers{1, -2, 3, 4, 5, -600};
  file.data_set("m", {2, 3}, integers, H5T_NATIVE_INT, H5T_STD_I16BE, packed);
  H5Pclose(packed);
  EXPECT_EQ(read_hdf5(file.bytes()).values, (std::vector<double>{1, -2, 3, 4, 5, -600}));
}

// c11_lzf.h5: the message did not say which filter.
TEST(Hdf5Map, NamesAFilterThatIsNotBuiltIn) {
  constexpr H5Z_filter_t kLzf = 32000;
  const H5Z_class2_t lzf{
      H5Z_CLASS_T_VERS,
      kLzf,
      1,
      1,
      "lzf",
      nullptr,
      nullptr,
      [](unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) { return bytes; }};
  H5Zregister(&lzf);
  const hid_t packed = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t chunk[2] = {1, 2};
  H5Pset_chunk(packed, 2, chunk);
  H5Pset_filter(packed, kLzf, 0, 0, nullptr);
  std::string bytes;
  {
    Hdf5TestFile file;
    file.doubles("/m", {2, 3}, kSixValues, packed);
    bytes = file.bytes();
  }
  H5Pclose(packed);
  H5Zunregister(kLzf);
  test::expect_input_error([&] { read_hdf5(bytes); }, {"map a.h5", "'/m'", "filter 'lzf'", "32000", "gzip"});
}

TEST(Hdf5Map, ListsTheMatricesOfAFileThatHoldsSeveral) {
  Hdf5TestFile file;
  file.doubles("/before", {2, 3}, kSixValues);
  file.doubles("/runs/after", {3, 2}, kSixValues);
  H5Lcreate_hard(file.file(), "/before", file.file(), "/again", H5P_DEFAULT, H5P_DEFAULT);
  const test::TemporaryFolder folder;
  const std::string name = folder.file("a.h5", file.bytes()).string();
  test::expect_input_error([&] { read_map(name); }, {"a.h5", "2 two-dimensional", ":/again", ":/runs/after"});
  MapReadOptions options;
  options.pitch = square_pitch(1.0);
  EXPECT_EQ(read_map(name + ":/runs/after", options).at(2, 1), 6.0);
  EXPECT_EQ(read_map(name + ":/before", options).at(1, 2), 6.0);
  EXPECT_EQ(read_map(name + ":runs/after", options).at(2, 1), 6.0) << "with or without the slash";
  test::expect_input_error([&] { read_map(name + ":/runs", options); }, {"a.h5:/runs", "'/runs'", "no data set"});
  test::expect_input_error([&] { read_map(name + ":/none", options); }, {"a.h5:/none", "'/none' is not there"});
  test::expect_input_error([&] { read_map(name + ":/before"); }, {"`map pixel`", "attribute pitch_mm"});
}

TEST(Hdf5Map, RefusesWhatIsNoMatrix) {
  Hdf5TestFile file;
  file.doubles("/line", {6}, kSixValues);
  file.doubles("/cube", {1, 2, 3}, kSixValues);
  file.meta_data({{"a", "b", "c"}});
  test::expect_input_error([&] { read_hdf5(file.bytes()); }, {"map a.h5", "no two-dimensional data set"});
  test::expect_input_error([&] { parse_hdf5_at(file.bytes(), "/cube", "map a"); }, {"'/cube'", "3 dimensions", "two"});
  test::expect_input_error([&] { parse_hdf5_at(file.bytes(), "/MetaData", "map a"); }, {"'/MetaData'", "1 dim"});
  test::expect_input_error([&] { read_hdf5("1,2\n"); }, {"map a.h5", "not an HDF5 file"});
}

TEST(Hdf5Map, NamesTheAttributeOfWhatItRefuses) {
  const auto refused = [](auto add, std::initializer_list<std::string> words) {
    Hdf5TestFile file;
    file.doubles("/m", {2, 3}, kSixValues);
    add(file);
    test::expect_input_error([&] { read_hdf5(file.bytes()); }, words);
  };
  refused([](auto& f) { f.number("/m", "pitch_mm", {-0.5}); }, {"pitch_mm", "'/m'", "-0.5", "> 0"});
  refused([](auto& f) { f.number("/m", "pitch_mm", {1, 2, 3}); }, {"pitch_mm", "or two"});
  refused([](auto& f) { f.text("/m", "pitch_mm", "0.5"); }, {"pitch_mm", "'0.5'", "finite number"});
  refused([](auto& f) { f.number("/m", "origin_mm", {1}); }, {"origin_mm", "two"});
  refused([](auto& f) { f.number("/m", "origin_mm", {1, NAN}); }, {"origin_mm", "finite"});
  refused([](auto& f) { f.number("/m", "unit", {1}); }, {"unit", "a text"});
}

TEST(Hdf5Map, RefusesSizesThatTheFileCannotHold) {
  const hid_t chunked = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t chunk[2] = {512, 512};
  H5Pset_chunk(chunked, 2, chunk);
  Hdf5TestFile sparse;  // nothing written: a few bytes that would become 8 GiB
  sparse.doubles("/m", {32768, 32768}, {}, chunked);
  test::expect_input_error([&] { read_hdf5(sparse.bytes()); }, {"map a.h5", "'/m'", "32768 x 32768", "1032"});
  Hdf5TestFile late;
  late.doubles("/m", {4096, 4096}, {});
  test::expect_input_error([&] { read_hdf5(late.bytes()); }, {"4096 x 4096", "1032"});
  const hsize_t huge[2] = {16384, 16384};
  H5Pset_chunk(chunked, 2, huge);
  Hdf5TestFile one_chunk;
  const hsize_t most[2] = {H5S_UNLIMITED, H5S_UNLIMITED}, now[2] = {2, 3};
  const hid_t space = H5Screate_simple(2, now, most);
  H5Dclose(H5Dcreate2(one_chunk.file(), "/m", H5T_IEEE_F64LE, space, H5P_DEFAULT, chunked, H5P_DEFAULT));
  H5Sclose(space);
  H5Pclose(chunked);
  test::expect_input_error([&] { read_hdf5(one_chunk.bytes()); }, {"'/m'", "chunks of 16384 x 16384"});
}

TEST(Hdf5Map, ReadsNoOtherFile) {
  const test::TemporaryFolder folder;
  Hdf5TestFile other;
  other.doubles("/m", {2, 3}, kSixValues);
  const std::string target = folder.file("other.h5", other.bytes()).string();
  const std::string raw = folder.file("raw.bin", std::string(48, '\1')).string();

  Hdf5TestFile file;
  H5Lcreate_external(target.c_str(), "/m", file.file(), "/linked", H5P_DEFAULT, H5P_DEFAULT);
  const hid_t outside = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_external(outside, raw.c_str(), 0, 48);
  file.doubles("/outside", {2, 3}, {}, outside);
  H5Pclose(outside);
  const hid_t both = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t sizes[2] = {2, 3};
  const hid_t space = H5Screate_simple(2, sizes, nullptr);
  H5Pset_virtual(both, space, target.c_str(), "/m", space);
  file.doubles("/virtual", {2, 3}, {}, both);
  H5Sclose(space);
  H5Pclose(both);

  const auto refused = [&](const std::string& path, const std::string& word) {
    test::expect_input_error([&] { parse_hdf5_at(file.bytes(), path, "map a"); }, {"map a", path, word});
  };
  refused("/linked", "not there");
  refused("/outside", "in other files");
  refused("/virtual", "in other files");
}

TEST(Hdf5Map, WritesTheSameBytesForTheSameMap) {
  HeightMap map(Grid{2, 3, 0.1, 0.25, {-1.0, 2.0}}, kSixValues);
  map.history = {"read a.dat", std::string(300, 'x')};
  const std::string bytes = hdf5_map_bytes(map);
  EXPECT_EQ(hdf5_map_bytes(map), bytes);
  const MapSource source = parse_hdf5_at(bytes, "/map", "map a");
  EXPECT_EQ(source.values, kSixValues);
  EXPECT_EQ(source.header.unit, "nm");
  EXPECT_EQ(source.header.history, map.history);
}

TEST(Hdf5Map, SurvivesTruncationAndDamage) {
  HeightMap map(Grid{2, 3, 0.1, 0.25, {-1.0, 2.0}}, kSixValues);
  map.history = {"one", "two"};
  const std::string whole = hdf5_map_bytes(map);
  for (std::size_t size = 8; size < whole.size(); size += 61) {
    test::expect_map_or_input_error([&] { return read_hdf5(whole.substr(0, size)); }, "map a.h5", std::to_string(size));
  }
  test::expect_survives_flips(whole, whole.size(), 150, read_hdf5, "map a.h5");
}

}  // namespace
}  // namespace dwell
