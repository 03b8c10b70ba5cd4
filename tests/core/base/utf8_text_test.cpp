#include "core/base/utf8_text.h"

#include <gtest/gtest.h>

namespace dwell {
namespace {

TEST(Utf8Text, EscapesOnlyWhatIsNone) {
  EXPECT_EQ(with_escaped_bytes("mirror.csv"), "mirror.csv");
  EXPECT_EQ(with_escaped_bytes("h\xC3\xB6he \xE2\x82\xAC \xF0\x9F\x94\xAD"),
            "h\xC3\xB6he \xE2\x82\xAC \xF0\x9F\x94\xAD");
  EXPECT_EQ(with_escaped_bytes("m\xE9tal"), "m\\xE9tal");
  EXPECT_EQ(with_escaped_bytes("cut \xE2\x82"), "cut \\xE2\\x82");
  EXPECT_EQ(with_escaped_bytes("\xED\xA0\x80"), "\\xED\\xA0\\x80");  // half of a pair
  EXPECT_EQ(with_escaped_bytes("\xC0\xAF"), "\\xC0\\xAF");           // longer than needed
}

TEST(Utf8Text, EscapesBecomeTheirBytesAgain) {
  for (const char* name : {"m\xe9.csv", "\xff\xfe", "plain.csv", "\xc3\xa9", ""}) {
    EXPECT_EQ(with_bytes_of_escapes(with_escaped_bytes(name)), name);
  }
  EXPECT_EQ(with_bytes_of_escapes("a\\x4"), "a\\x4");
  EXPECT_EQ(with_bytes_of_escapes("a\\xZZ\\"), "a\\xZZ\\");
}

TEST(Utf8Text, IsKnown) {
  EXPECT_TRUE(is_utf8(""));
  EXPECT_TRUE(is_utf8("a \xC2\xB5m"));
  EXPECT_FALSE(is_utf8("a \xB5m"));
  EXPECT_EQ(utf8_length("\xC2\xB5m"), 2u);
  EXPECT_EQ(utf8_length("\xB5m"), 0u);
}

}  // namespace
}  // namespace dwell
