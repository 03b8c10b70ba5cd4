#include "runs/machine/machine_option.h"

#include <gtest/gtest.h>

#include <string>

#include "core/base/errors.h"
#include "runs/machine/machine_table.h"

namespace dwell {
namespace {

TEST(MachineOption, HoldsTheFieldsOfAMachineInOneLine) {
  const toml::table table = toml::parse(
      "name = \"a\\nb\"\nmax_feed_mm_per_min = 1234.5\n[corner]\nrule = 'free'\n[x]\nletter = \"U\"\n"
      "max_speed_mm_per_s = 7\n");
  const std::string text = inline_machine_text(table);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  ASSERT_TRUE(is_inline_machine(text));
  const NamedMachine machine = machine_of_option(text);
  EXPECT_EQ(machine.name, "a\nb");
  EXPECT_EQ(machine.machine.max_feed, 1234.5 / 60.0);
  EXPECT_EQ(machine.machine.corner, CornerRule::Free);
  EXPECT_EQ(machine.machine.letters.x, 'U');
  EXPECT_EQ(machine.machine.x.max_speed, 7.0);
  EXPECT_FALSE(is_inline_machine("machine.toml"));
}

std::string refusal_of(const std::string& option) {
  try {
    machine_of_option(option);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MachineOption, RefusesByFieldAndValue) {
  EXPECT_EQ(refusal_of("{ corner = { delay_s = -1 } }"),
            "the fields: corner.delay_s = -1; required a finite number >= 0 (without quotes)");
  EXPECT_EQ(refusal_of("{ x = { letter = \"U\" }, y = { letter = \"U\" } }"),
            "the fields: machine: x.letter = U and y.letter = U; required two letters");
  EXPECT_NE(refusal_of("{ max_feed_mm_per_min = 3 "), "");
  EXPECT_NE(refusal_of("{} \n out = 3"), "");
}

}  // namespace
}  // namespace dwell
