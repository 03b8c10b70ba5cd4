/// Programs in layouts that a template describes: what is written reads back as the same motion.

#include "runs/programs/program_template.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/whole_file.h"
#include "paths/feed/machine_check.h"
#include "runs/programs/shipped_templates.h"
#include "runs/programs/template_reader.h"
#include "runs/programs/template_writer.h"
#include "tests/runs/programs/program_cases.h"
#include "tests/runs/programs/pvt_cases.h"

namespace dwell {
namespace {

using program_cases::input_error;
using program_cases::replaced;

TemplateWriting usual_writing() { return {5.0, 3000.0, {"dwell 0.0", "input: map mirror [2].csv sha256=abc"}}; }

/// Two stretches with feeds, of which the second begins elsewhere; no symmetry, a halt within and one at the end.
Program with_feeds() {
  Program program;
  Point at{-3.25, 7.125};
  for (int i = 0; i < 9; ++i) {
    const Point to = at + Point{0.71 - 0.13 * i, 0.2 + 0.05 * i * i};
    program.steps.push_back({at, to, 0.3 + 0.04 * i, true});
    at = to;
    if (i == 2) program.steps.push_back({at, at, 0.0625, true});
    if (i == 4) {
      program.steps.push_back({at, {1.5, -2.25}, 0.0, false});
      at = {1.5, -2.25};
    }
  }
  program.steps.push_back({at, at, 0.75, true});
  return program;
}

struct Closeness {
  double place, seconds, speed;
};

std::vector<ProgramStep> steps_at_work(const Program& program) {
  std::vector<ProgramStep> steps;
  std::copy_if(program.steps.begin(), program.steps.end(), std::back_inserter(steps),
               [](const ProgramStep& step) { return step.removes; });
  return steps;
}

/// Steps at work, and lifts between the same of them; a lifted way has no time and no steps in these layouts.
void expect_same(const Program& read, const Program& written, const Closeness& within) {
  const std::vector<ProgramStep> as = steps_at_work(read), bs = steps_at_work(written);
  ASSERT_EQ(as.size(), bs.size());
  for (std::size_t i = 0; i < as.size(); ++i) {
    const ProgramStep &a = as[i], &b = bs[i];
    EXPECT_LE(distance(a.start, b.start), within.place) << i;
    EXPECT_LE(distance(a.finish, b.finish), within.place) << i;
    EXPECT_NEAR(a.seconds, b.seconds, within.seconds) << i;
    ASSERT_EQ(a.speeds.has_value(), b.speeds.has_value()) << i;
    if (!a.speeds) continue;
    EXPECT_LE(distance(a.speeds->in, b.speeds->in), within.speed) << i;
    EXPECT_LE(distance(a.speeds->out, b.speeds->out), within.speed) << i;
  }
}

/// What the layout can say: feeds, or a motion in its times.
Program for_layout(const ProgramTemplate& layout) {
  return layout.speeds ? motion_for_template(pvt_cases::lifted_motion(), layout) : with_feeds();
}

TEST(ProgramTemplate, ReadsBackWhatTheShippedOnesWrite) {
  struct Case {
    std::string name;
    Closeness within;
  };
  ASSERT_EQ(shipped_template_names(), "aerotech-a3200, fanuc, galil, siemens-840d");
  for (const Case& c : {Case{"siemens-840d", {1e-6, 1e-6, 0.0}}, Case{"fanuc", {1e-3, 1e-3, 0.0}},
                        Case{"aerotech-a3200", {1.5e-6, 1e-9, 1.5e-6}}, Case{"galil", {1e-4, 1e-9, 1e-4}}}) {
    const ProgramTemplate layout = find_program_template(c.name);
    const Program program = for_layout(layout);
    const std::string text = text_by_template(program, layout, usual_writing());
    SCOPED_TRACE(c.name + "\n" + text);
    const Program read = read_by_template(text, layout.output(), layout);
    expect_same(read, program, c.within);
    EXPECT_GT(read.rapid_length, 1.0);
    for (const std::string_view line : split(text, '\n')) EXPECT_LE(line.size(), c.name == "fanuc" ? 81U : 120U);
  }
}

TEST(ProgramTemplate, ShippedOnesAreTheFiles) {
  for (const auto& [name, text] : shipped_templates()) {
    std::string file = name;
    std::replace(file.begin(), file.end(), '-', '_');
    EXPECT_EQ(text, read_whole_file(std::string(DWELL_SOURCE_DIR) + "/data/templates/" + file + ".toml"));
  }
}

TEST(ProgramTemplate, WritesWhatControllersTake) {
  const std::string siemens = text_by_template(with_feeds(), find_program_template("siemens-840d"), usual_writing());
  EXPECT_EQ(siemens.find_first_of("()"), std::string::npos);
  EXPECT_NE(siemens.find("; dwell 0.0\n"), std::string::npos);
  EXPECT_NE(siemens.find("\nN10 G17 G90 G94 G710\nN20 G64\nN30 COMPOF\nN40 G0 Z5.000\nN50 G0 X-3.250000 Y7.125000\n"),
            std::string::npos);
  EXPECT_TRUE(siemens.ends_with("G4 F0.750000\nN210 G0 Z5.000\nM30\n")) << siemens;
  const std::string fanuc = text_by_template(with_feeds(), find_program_template("fanuc"), usual_writing());
  EXPECT_TRUE(fanuc.starts_with("%\r\nO1000\r\n(DWELL 0.0)\r\n(INPUT: MAP MIRROR [2].CSV SHA256=ABC)\r\n")) << fanuc;
  EXPECT_TRUE(fanuc.ends_with("G4 P750\r\nG0 Z5.000\r\nM30\r\n%\r\n")) << fanuc;
  EXPECT_EQ(fanuc.find_first_of("abcdefghijklmnopqrstuvwxyz"), std::string::npos);
}

// Each start of the motion finds 200 steps in the buffer, or all where there are fewer.
TEST(ProgramTemplate, StartsAMotionOnceSoManyStepsAreInTheBuffer) {
  ProgramTemplate layout = find_program_template("galil");
  Program program;
  for (int i = 0; i < 300; ++i) {
    const Point from{0.01 * i, -0.003 * i}, to{0.01 * (i + 1), -0.003 * (i + 1)};
    const Point none{}, speed{0.5, -0.15};
    program.steps.push_back({from, to, 0.0205078125, true, EndSpeeds{i == 0 ? none : speed, i == 299 ? none : speed}});
  }
  const std::string text = text_by_template(program, layout, usual_writing());
  std::size_t moves = 0, before = 0;
  for (const std::string_view line : split(text, '\n')) {
    moves += line.starts_with("JS#ROOM;PVX=") ? 1 : 0;
    if (line == "BTXY") before = moves;
    EXPECT_EQ(line.find('.', line.starts_with("JS#ROOM") ? 0 : line.size()), std::string_view::npos) << line;
  }
  EXPECT_EQ(moves, 300U);
  EXPECT_EQ(before, 200U);
  EXPECT_EQ(read_by_template(text, "p", layout).steps.size(), 300U);
}

TEST(ProgramTemplate, LetsNoErrorAddUp) {
  const ProgramTemplate layout = find_program_template("galil");
  Program program;
  for (int i = 0; i < 3000; ++i) {
    const Point from{0.012345678 * i, -0.003 * i}, to{0.012345678 * (i + 1), -0.003 * (i + 1)};
    program.steps.push_back({from, to, 0.0173, true, EndSpeeds{}});
  }
  const Program read = read_by_template(text_by_template(program, layout, usual_writing()), "p", layout);
  EXPECT_LE(distance(read.steps.back().finish, program.steps.back().finish), 1e-4);
  EXPECT_NEAR(read.total_seconds(), 3000 * 0.0173, 1e-3);
}

/// The oracle: where the tool is at a time, from the steps alone.
Point place_when(const Program& program, double seconds) {
  for (const ProgramStep& step : program.steps) {
    if (seconds > step.seconds) {
      seconds -= step.seconds;
      continue;
    }
    if (!step.speeds) return step.start + (seconds / step.seconds) * (step.finish - step.start);
    const double t = seconds / step.seconds, h = step.seconds;
    return (1 + 2 * t) * (1 - t) * (1 - t) * step.start + t * (1 - t) * (1 - t) * h * step.speeds->in +
           t * t * (3 - 2 * t) * step.finish + t * t * (t - 1) * h * step.speeds->out;
  }
  return program.steps.back().finish;
}

TEST(ProgramTemplate, ACoarseClockMovesPlacesAlongTheMotion) {
  const ProgramTemplate layout = find_program_template("galil");
  const Program motion = pvt_cases::lifted_motion(), coarse = motion_for_template(motion, layout);
  double seconds = 0.0;
  for (const ProgramStep& step : coarse.steps) {
    EXPECT_LE(step.seconds, 2.0);
    seconds += step.seconds;
    EXPECT_NEAR(seconds * 1024.0, std::round(seconds * 1024.0), 1e-6);
    EXPECT_LE(distance(step.finish, place_when(motion, seconds)), 2e-5);  // a rest stays where it is
  }
  EXPECT_NEAR(seconds, motion.total_seconds(), 1e-3);
}

constexpr const char* kShort = R"(schema = 1
name = "short"
ending = ".txt"
comment = "; {text}"
every = 2
[numbers]
t = { decimals = 3 }
[blocks]
header = "BEGIN"
travel = "GO {x} {y}"
lower = "DOWN"
group_begin = "GROUP {n}"
group_end = "END OF GROUP"
move = "TO {x} {y} IN {t}"
halt = "WAIT {t}"
lift = "UP"
footer = "END"
)";

TEST(ProgramTemplate, PutsMovesInGroups) {
  const ProgramTemplate layout = parse_program_template(kShort, "short.toml");
  Program program;
  for (int i = 0; i < 3; ++i) program.steps.push_back({{1.0 * i, 0.5}, {1.0 * i + 1.0, 0.5}, 0.25, true});
  const std::string text = text_by_template(program, layout, {5.0, 600.0, {"note (1)"}});
  EXPECT_EQ(text,
            "BEGIN\n; note [1]\n; dwell: template=short\nGO 0.000000 0.500000\nDOWN\nGROUP 1\nTO 1.000000 0.500000 IN "
            "0.250\nTO 2.000000 0.500000 IN 0.250\nEND OF GROUP\nGROUP 3\nTO 3.000000 0.500000 IN 0.250\nEND OF GROUP\n"
            "UP\nEND\n");
  expect_same(read_by_template(text, "p.txt", layout), program, {1e-9, 1e-9, 0.0});
}

TEST(ProgramTemplate, LaysFeedsInTheProgramsFrame) {
  for (const char* name : {"siemens-840d", "fanuc"}) {
    const ProgramTemplate layout = find_program_template(name);
    Program program = with_feeds();
    program.frame = ProgramFrame({12.5, -3.0}, 30.0, true);
    const std::string text = text_by_template(program, layout, usual_writing());
    const Point first = program.frame.to_program(program.steps.front().start);
    EXPECT_NE(text.find(fmt::format("X{:.{}f} Y", first.x, layout.number("x").decimals)), std::string::npos) << text;
    const Program read = read_by_template(text, "p", layout);
    EXPECT_EQ(read.frame, program.frame);
    expect_same(read, program, {1e-3, 1e-3, 0.0});
  }
}

TEST(ProgramTemplate, FeedsAreThoseOfRoundedPlacesAndNoneIsAboveTheMaximum) {
  const ProgramTemplate layout = find_program_template("fanuc");
  Program program;
  const double feed = 600.0;
  Point at{0.0004, 0.0003};
  for (int i = 0; i < 40; ++i) {
    const Point to = at + Point{0.0317 + 1e-4 * i, 0.0113};
    program.steps.push_back({at, to, distance(at, to) / units::mm_per_s(feed), true});
    at = to;
  }
  program.steps.push_back({at, at + Point{0.0001, 0.0}, 0.004, true});  // shorter than the last decimal
  const Program read = read_by_template(text_by_template(program, layout, {5.0, feed, {}}), "p", layout);
  EXPECT_LE(read.fastest_feed, units::mm_per_s(feed) * (1.0 + 1e-12));
  for (std::size_t i = 0; i + 1 < read.steps.size(); ++i)
    EXPECT_NEAR(read.steps[i].seconds, program.steps[i].seconds, 1e-4) << i;
  EXPECT_EQ(read.steps.back().length(), 0.0);
  EXPECT_NEAR(read.steps.back().seconds, 0.004, 1e-12);
  const std::string slow = input_error([&] {
    Program crawl;
    crawl.steps = {{{0, 0}, {0.01, 0}, 3000.0, true}};
    text_by_template(crawl, layout, {5.0, feed, {}});
  });
  EXPECT_NE(slow.find("is 0 in the 3 decimals of numbers.f"), std::string::npos) << slow;
}

TEST(ProgramTemplate, RefusesWhatItDoesNotKnow) {
  struct Case {
    std::string what, with, says;
  };
  for (const Case& c :
       {Case{"every = 2", "evry = 2", "line 5: evry: unknown field; accepted: schema, name"},
        Case{"TO {x}", "TO {q}", "blocks.move: unknown field {q}; accepted: x, y"},
        Case{" IN {t}", "", "blocks.move: required one of {t}, {time} and {f}"},
        Case{"IN {t}", "IN {t} AT {f}", "blocks.move: required one of {t}, {time} and {f}"},
        Case{"TO {x} {y}", "TO {x}", "blocks.move: required one of {x} and {dx}"},
        Case{"TO {x} {y}", "TO {x} {y} {dx}", "blocks.move: required one of {x} and {dx}"},
        Case{"lift = \"UP\"", "", "blocks.lift: required"},
        Case{"{x} {y} IN", "{x}{y} IN", "nothing between"},
        Case{"WAIT {t}", "WAIT {t", "not closed"},
        Case{"\"DOWN\"", "\"D\xc3\xb6WN\"", "printable ASCII"},
        Case{"decimals = 3", "decimals = 13", "numbers.t.decimals = 13; required a whole number from 0 to 12"},
        Case{"decimals = 3", "digits = 3", "numbers.t.digits: unknown field; accepted: per_unit"},
        Case{"decimals = 3", "per_unit = 0", "numbers.t.per_unit = 0; required"},
        Case{"decimals = 3", "per_unit = nan", "required a number from"},
        Case{"schema = 1", "schema = 2", "schema = 2; required 1"},
        Case{"\"; {text}\"", "\"{text}\"", "required the sign of a comment"},
        Case{"every = 2", "", "every = N"},
        Case{"IN {t}", "AT {vx} IN {t}", "speeds = true"},
        Case{"every = 2", "every = 2\nspeeds = true", "{vx} and {vy}"},
        Case{"every = 2", "every = 2\nstart_after = 3", "both or none"},
        Case{"every = 2", "every = 2\nspeeds = 1", "speeds = 1; required true or false"},
        Case{"every = 2", "every = 2\nlongest_step_s = 1.5", "longest_step_s"},
        Case{"every = 2", "every = 2\nblock_numbers = 10", "block_numbers = 10; required { step"},
        Case{"every = 2", "every = 2\nblock_numbers = { step = 10, last = 5 }", "last is below step"},
        Case{"\".txt\"", "\"../x\"", "ending = '../x'; required"},
        Case{"\".txt\"", "\".\"", "required the ending"},
        Case{"BEGIN", "G90 G20", "looks like inches"},
        Case{"[numbers]", "[numbers\n", "short.toml: line"},
        Case{"name = \"short\"", "", "name: required"}}) {
    const std::string text = replaced(kShort, c.what, c.with);
    const std::string message = input_error([&] { parse_program_template(text, "short.toml"); });
    EXPECT_NE(message.find(c.says), std::string::npos) << c.with << ": " << message;
    EXPECT_EQ(message.find("short.toml"), 0U) << message;
  }
  const std::string missing = input_error([] { find_program_template("heidenhain"); });
  EXPECT_NE(missing.find("comes with dwell: aerotech-a3200, fanuc"), std::string::npos) << missing;
}

TEST(ProgramTemplate, RefusesProgramsThatAreNotOfIt) {
  const ProgramTemplate layout = parse_program_template(kShort, "short.toml");
  const std::string good = "BEGIN\n; a tool\nGO 0 1\nDOWN\nGROUP 1\nTO 1 1 IN 0.5\nWAIT 2\nEND OF GROUP\nUP\nEND\n";
  EXPECT_EQ(read_by_template(good, "p.txt", layout).steps.size(), 2U);
  struct Case {
    std::string what, with, says;
  };
  for (const Case& c :
       {Case{"IN 0.5", "IN 0", "line 6: a time of 0 s; required"}, Case{"IN 0.5", "IN -1", "t = -1 s; required"},
        Case{"TO 1 1 IN 0.5", "TO 1 1", "line 6: 'TO 1 1' is no move; accepted: 'TO {x} {y} IN {t}'"},
        Case{"TO 1 1", "TO 1e7 1", "line 6"}, Case{"TO 1 1", "TO 10000000 1", "x = 10000000"},
        Case{"DOWN\n", "", "block `lower`"}, Case{"UP\nEND\n", "UP\n", "its end is where the block `footer`"},
        Case{"UP\nEND\n", "", "truncated"}, Case{"UP\nEND\n", "UP\nEND\nTO 1 1 IN 3\n", "after the footer"},
        Case{"0.5", "5e-1", "'TO 1 1 IN 5e-1'"}, Case{"BEGIN", "BEGINN", "'BEGINN'"},
        Case{"GROUP 1\nTO 1 1 IN 0.5\nWAIT 2\nEND OF GROUP\n", "", "the first move or halt"},
        Case{"a tool", "coordinates in um", "another unit"}, Case{"a tool", "F in mm/s", "another unit"},
        Case{"a tool", "dwell: template=long", "by \"short\"; required the same"},
        Case{"a tool", "dwell: zero=1/2", "how the program lies"}}) {
    const std::string message = input_error([&] { read_by_template(replaced(good, c.what, c.with), "p.txt", layout); });
    EXPECT_NE(message.find(c.says), std::string::npos) << c.with << ": " << message;
  }
}

TEST(ProgramTemplate, RefusesMotionThatNoMachineMakes) {
  const ProgramTemplate layout = find_program_template("aerotech-a3200");
  const std::string good = text_by_template(for_layout(layout), layout, usual_writing());
  const std::size_t end = good.rfind("PVT X "), comma = good.find(',', end);
  const std::string moving = std::string(good).replace(comma + 1, 1, "7");
  const std::string message = input_error([&] { read_by_template(moving, "p.pgm", layout); });
  EXPECT_NE(message.find("required 0"), std::string::npos) << message;
  const std::string down = replaced(good, "G0 Z5.000000", "G0 Z0.000000");
  EXPECT_NE(input_error([&] { read_by_template(down, "p.pgm", layout); }).find("the tool is lifted there"),
            std::string::npos);
}

TEST(ProgramTemplate, RefusesAScheduleThatItCannotSay) {
  const Program speeds = pvt_cases::lifted_motion();
  EXPECT_NE(input_error([] {
              text_by_template(with_feeds(), find_program_template("galil"), usual_writing());
            }).find("`machine`"),
            std::string::npos);
  EXPECT_NE(input_error([&] {
              text_by_template(speeds, find_program_template("fanuc"), usual_writing());
            }).find("`schedule` = constant"),
            std::string::npos);
}

TEST(ProgramTemplate, RefusesLinesThatAreTooLongOrTooMany) {
  const std::string wide = replaced(kShort, "every = 2", "every = 2\nlongest_line = 24");
  const std::string message =
      input_error([&] { text_by_template(with_feeds(), parse_program_template(wide, "short.toml"), usual_writing()); });
  EXPECT_NE(message.find("characters; the template allows 24"), std::string::npos) << message;
  const std::string few = replaced(kShort, "every = 2", "every = 2\nmost_lines = 9");
  EXPECT_NE(input_error([&] {
              text_by_template(with_feeds(), parse_program_template(few, "short.toml"), usual_writing());
            }).find("more than the 9 lines"),
            std::string::npos);
}

}  // namespace
}  // namespace dwell
