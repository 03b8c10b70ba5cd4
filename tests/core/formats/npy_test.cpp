#include "core/formats/npy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

/// An NPY file written by hand from its specification (numpy.lib.format).
std::string npy(const std::string& dictionary, const std::string& data, int version = 1) {
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  bytes += static_cast<char>(dictionary.size() + 1);
  bytes += '\0';
  if (version > 1) bytes += std::string(2, '\0');
  return bytes + dictionary + "\n" + data;
}

std::string dictionary(const std::string& descr, const std::string& shape, const std::string& fortran = "False") {
  return "{'descr': '" + descr + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }";
}

TEST(Npy, ReadsBothOrdersAsRowsAndColumns) {
  const std::string data{1, 2, 3, 4, 5, 6};
  const MapSource c = parse_npy(npy(dictionary("|u1", "(2, 3)"), data), "map a.npy");
  EXPECT_EQ(c.rows, 2);
  EXPECT_EQ(c.cols, 3);
  EXPECT_EQ(c.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  const MapSource fortran = parse_npy(npy(dictionary("|u1", "(2, 3)", "True"), data), "map a.npy");
  EXPECT_EQ(fortran.rows, 2);
  EXPECT_EQ(fortran.cols, 3);
  EXPECT_EQ(fortran.values, (std::vector<double>{1, 3, 5, 2, 4, 6}));
}

TEST(Npy, ReadsEveryVersionOfTheFormat) {
  for (const int version : {1, 2, 3}) {
    const MapSource matrix = parse_npy(npy(dictionary("|i1", "(1, 2)"), "\x07\xff", version), "map a.npy");
    EXPECT_EQ(matrix.values, (std::vector<double>{7, -1})) << version;
  }
}

TEST(Npy, ReadsEveryElementTypeInBothByteOrders) {
  using namespace std::string_literals;
  struct Case {
    std::string descr, data;
    double value;
  };
  for (const Case& c :
       {Case{"<f8", "\0\0\0\0\0\0\x04\xc0"s, -2.5}, Case{">f8", "\xc0\x04\0\0\0\0\0\0"s, -2.5},
        Case{"<f4", "\0\0\x20\xc0"s, -2.5}, Case{">f4", "\xc0\x20\0\0"s, -2.5}, Case{"<i2", "\xfe\xff"s, -2.0},
        Case{">i2", "\xff\xfe"s, -2.0}, Case{"<u2", "\x01\x80"s, 32769.0}, Case{">i4", "\0\x01\0\0"s, 65536.0},
        Case{"<i4", "\xff\xff\xff\xff"s, -1.0}, Case{"<u4", "\xff\xff\xff\xff"s, 4294967295.0},
        Case{"<i8", "\xff\xff\xff\xff\xff\xff\xff\xff"s, -1.0}, Case{">u8", "\0\0\0\0\0\0\x01\x02"s, 258.0},
        Case{"|i1", "\x80"s, -128.0}, Case{"|u1", "\x80"s, 128.0}}) {
    const MapSource matrix = parse_npy(npy(dictionary(c.descr, "(1, 1)"), c.data), "map a.npy");
    EXPECT_EQ(matrix.values.at(0), c.value) << c.descr;
  }
}

TEST(Npy, NamesWhatItRefuses) {
  const auto refused = [](const std::string& bytes, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { parse_npy(bytes, "map a.npy"); }, words);
  };
  const std::string one(8, '\0');
  refused("1,2\n", {"map a.npy", "not an NPY"});
  refused("\x93NUMPY", {"truncated", "6 bytes"});
  refused(npy(dictionary("<f8", "(1, 1)"), one, 4), {"version 4"});
  refused(npy(dictionary("<f8", "(1, 1)"), one).substr(0, 40), {"truncated", "40 bytes"});
  refused(npy(dictionary("<f8", "(2, 3)"), one), {"truncated", "(2, 3)", "8 bytes"});
  refused(npy(dictionary("<f8", "(1, 1)"), one + "x"), {"overlong", "9 bytes"});
  refused(npy(dictionary("<f8", "(4294967296, 4294967296)"), ""), {"truncated"});
  refused(npy(dictionary("<f8", "(1,)"), one), {"shape (1,)", "two dimensions"});
  refused(npy(dictionary("<f8", "()"), one), {"shape ()", "two dimensions"});
  refused(npy(dictionary("<f8", "(1, 1, 1)"), one), {"shape (1, 1, 1)", "two dimensions"});
  refused(npy(dictionary("<f8", "(0, 4)"), ""), {"shape (0, 4)", "at least 1"});
  refused(npy(dictionary("<f8", "(-1, 4)"), ""), {"shape (-1, 4)"});
  refused(npy(dictionary("<f8", "(1, 1"), one), {"shape"});
  refused(npy(dictionary("<c16", "(1, 1)"), one + one), {"<c16", "f4, f8"});
  refused(npy(dictionary("|b1", "(1, 1)"), "\x01"), {"|b1"});
  refused(npy(dictionary("<f8", "(1, 1)", "Maybe"), one), {"fortran_order"});
  refused(npy("{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (1, 1), }", one), {"element type [('x'"});
  refused(npy("{'descr': '<f8', 'shape': (1, 1), }", one), {"no 'fortran_order'"});
}

TEST(Npy, WritesMapsThatReadBack) {
  const HeightMap map({2, 3, 0.1, 0.1, {}}, {0.1, -2.0, 1e-310, 1e300, NAN, 1.0 / 3.0});
  const std::string bytes = npy_bytes(map);
  EXPECT_EQ((bytes.size() - 6 * 8) % 64, 0u);  // data begin on a multiple of 64 bytes
  EXPECT_NE(bytes.find("'shape': (2, 3)"), std::string::npos);
  const MapSource matrix = parse_npy(bytes, "map a.npy");
  EXPECT_EQ(matrix.rows, 2);
  EXPECT_EQ(matrix.cols, 3);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(matrix.values[i] == map.values[i] || (i == 4 && std::isnan(matrix.values[i]))) << i;
  }
}

TEST(Npy, WritesVectorsByteForByte) {
  using namespace std::string_literals;
  const std::vector<double> values{-2.5, 1.0};
  const std::string bytes = npy_bytes(values);
  EXPECT_EQ(bytes.substr(0, 10), "\x93NUMPY\x01\0\x76\0"s);
  EXPECT_EQ(bytes.substr(10, 58), "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), } ");
  EXPECT_EQ(bytes[127], '\n');
  EXPECT_EQ(bytes.substr(128), "\0\0\0\0\0\0\x04\xc0\0\0\0\0\0\0\xf0\x3f"s);
}

}  // namespace
}  // namespace dwell
