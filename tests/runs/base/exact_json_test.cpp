#include "runs/base/exact_json.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace dwell {
namespace {

enum class Colouring { Plain, Bright };

struct InnerFields {
  double number = 0.0;
  std::vector<std::string> words;
};
struct OuterFields {
  InnerFields inner;
  std::vector<InnerFields> several;
  std::array<double, 2> pair{};
  std::optional<double> maybe, missing;
  long count = 0;
  bool yes = false;
  Colouring colour = Colouring::Plain;
};

template <class Visit>
void each_field(InnerFields& inner, const Visit& visit) {
  visit("number", inner.number), visit("words", inner.words);
}
template <class Visit>
void each_field(OuterFields& outer, const Visit& visit) {
  visit("inner", outer.inner), visit("several", outer.several), visit("pair", outer.pair);
  visit("maybe", outer.maybe), visit("missing", outer.missing), visit("count", outer.count);
  visit("yes", outer.yes), visit("colour", outer.colour);
}

/// Through the text of a file.
template <class Value>
Value there_and_back(const Value& value) {
  Value back{};
  read_exact(nlohmann::ordered_json::parse(exact_json(value).dump(2)), back);
  return back;
}

TEST(ExactJson, BringsEveryNumberBackToTheBit) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 20000; ++k) {
    const auto number = std::bit_cast<double>(random());
    const double back = there_and_back(number);
    if (std::isnan(number)) {
      EXPECT_TRUE(std::isnan(back));
    } else {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(number)) << number;
    }
  }
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double number : {0.0, -0.0, 1.0, -3.0, 1e22, 5e-324, infinite, -infinite})
    EXPECT_EQ(std::bit_cast<std::uint64_t>(there_and_back(number)), std::bit_cast<std::uint64_t>(number)) << number;
}

TEST(ExactJson, BringsBackValuesOfEveryKind) {
  const OuterFields outer{
      {0.1, {"a", "b"}}, {{1.0 / 3.0, {}}, {2.0, {"c"}}}, {3.0, 4.5}, 0.2, {}, -123456789012345, true,
      Colouring::Bright};
  const OuterFields back = there_and_back(outer);
  EXPECT_EQ(back.inner.number, 0.1);
  EXPECT_EQ(back.inner.words, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(back.several.size(), 2U);
  EXPECT_EQ(back.several[0].number, 1.0 / 3.0);
  EXPECT_EQ(back.several[1].words, (std::vector<std::string>{"c"}));
  EXPECT_EQ(back.pair, outer.pair);
  EXPECT_EQ(back.maybe, 0.2);
  EXPECT_FALSE(back.missing.has_value());
  EXPECT_EQ(back.count, outer.count);
  EXPECT_TRUE(back.yes);
  EXPECT_EQ(back.colour, Colouring::Bright);
}

TEST(ExactJson, RefusesWhatLacksAFieldOrIsOfAnotherKind) {
  nlohmann::ordered_json whole = exact_json(OuterFields{});
  OuterFields back;
  EXPECT_NO_THROW(read_exact(whole, back));
  for (const char* key : {"inner", "pair", "missing", "count"}) {
    nlohmann::ordered_json less = whole;
    less.erase(key);
    EXPECT_THROW(read_exact(less, back), nlohmann::json::exception) << key;
  }
  for (const auto& wrong :
       {nlohmann::ordered_json{1.0}, nlohmann::ordered_json{1.0, 2.0, 3.0}, nlohmann::ordered_json("none")}) {
    whole["pair"] = wrong;
    EXPECT_THROW(read_exact(whole, back), InputError) << wrong;
  }
}

}  // namespace
}  // namespace dwell
