// The rules of the house hold for the tree, and the checker that says so finds every way to break them.

#include "tests/architecture/house_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

namespace dwell::architecture {

void PrintTo(const Violation& violation, std::ostream* os) { *os << violation.to_string(); }
void PrintTo(const SourceFile& file, std::ostream* os) { *os << file.path << ": " << file.text; }

namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

auto violation(const std::string& path, std::size_t line, const std::string& part) {
  return AllOf(Field(&Violation::path, path), Field(&Violation::line, line),
               Field(&Violation::message, HasSubstr(part)));
}

// The smallest house without fault.
std::vector<SourceFile> sound_house() {
  return {{"core/numerics/fourier.h", "#pragma once\n"},
          {"core/numerics/fourier.cpp", "#include \"core/numerics/fourier.h\"\n\n#include <fftw3.h>\n"},
          {"paths/raster.h", "#include \"core/numerics/fourier.h\"\n"},
          {"solvers/gradient.h", "#include <Eigen/Core>\n"},
          {"runs/plan.h", "#include \"paths/raster.h\"\n#include \"solvers/gradient.h\"\n"},
          {"cli/plan_command.cpp", "#include <CLI/CLI.hpp>\n#include \"runs/plan.h\"\n"}};
}

TEST(HouseRules, HoldForTheTree) {
  const std::vector<SourceFile> files = read_house(DWELL_SOURCE_DIR);
  EXPECT_THAT(files, ::testing::Contains(Field(&SourceFile::path, "core/motion/tool_path.cpp")));
  EXPECT_THAT(check_house(files), IsEmpty());
}

TEST(HouseRules, AcceptASoundHouse) { EXPECT_THAT(check_house(sound_house()), IsEmpty()); }

struct Break {
  const char* name;
  SourceFile file;
  std::size_t line;
  const char* part;
};

class FileRule : public ::testing::TestWithParam<Break> {};

TEST_P(FileRule, IsEnforced) {
  const Break& b = GetParam();
  EXPECT_THAT(check_file(b.file), ElementsAre(violation(b.file.path, b.line, b.part)));
}

INSTANTIATE_TEST_SUITE_P(
    , FileRule,
    ::testing::Values(
        Break{"CoreSeesPaths", {"core/a.h", "#pragma once\n\n#include \"paths/b.h\"\n"}, 3, "core (rank 0) may not"},
        Break{"PathsSeeSolvers", {"paths/a.cpp", "#include \"solvers/b.h\"\n"}, 1, "paths (rank 1) may not"},
        Break{"SolversSeePaths", {"solvers/a.cpp", "#include \"paths/b.h\"\n"}, 1, "solvers (rank 1) may not"},
        Break{"RunsSeeCli", {"runs/a.cpp", "\n#include \"cli/b.h\"\n"}, 2, "runs (rank 2) may not"},
        Break{"AngleBrackets", {"core/a.h", "#include <runs/b.h>\n"}, 1, "core (rank 0) may not"},
        Break{"OddSpacing", {"core/a.h", "  #  include\"runs/b.h\" // why\n"}, 1, "core (rank 0) may not"},
        Break{"WindowsLineEnds", {"core/a.h", "#pragma once\r\n#include \"runs/b.h\"\r\n"}, 2, "core (rank 0) may not"},
        Break{"Subfolder", {"paths/surface/a.h", "#include \"solvers/b.h\"\n"}, 1, "paths (rank 1) may not"},
        Break{"NoFolder", {"core/a.cpp", "#include \"a.h\"\n"}, 1, "in no folder"},
        Break{"UpAndOver", {"core/a.cpp", "#include \"../paths/b.h\"\n"}, 1, "in no folder"},
        Break{"Tests", {"core/a.cpp", "#include \"tests/b.h\"\n"}, 1, "in no folder"},
        Break{"Macro", {"core/a.cpp", "#include HEADER\n"}, 1, "by macro"},
        Break{"CeresElsewhere", {"solvers/native/gradient.cpp", "#include <ceres/ceres.h>\n"}, 1, "solvers/peers"},
        Break{"CeresInCore", {"core/ceres_fit.cpp", "#include <ceres/ceres.h>\n"}, 1, "solvers/fits"},
        Break{"NLoptElsewhere", {"solvers/fits/registration.cpp", "#include <nlopt.hpp>\n"}, 1, "solvers/weights"},
        Break{"Hdf5Elsewhere", {"core/formats/zygo_datx.cpp", "#include <hdf5.h>\n"}, 1, "core/formats/hdf5_*"},
        Break{"FitsElsewhere", {"runs/fits_picture.cpp", "#include <fitsio.h>\n"}, 1, "core/formats/fits_*"},
        Break{"CairoElsewhere", {"runs/reports/tif_picture.cpp", "#include <cairo-svg.h>\n"}, 1, "only runs/drawing"},
        Break{"FftwInSolvers", {"solvers/a.cpp", "#include <fftw3.h>\n"}, 1, "only core/numerics"},
        Break{"CmathInCli", {"cli/a.cpp", "#include <cmath>\n"}, 1, "no mathematics"},
        Break{"EigenInCli", {"cli/a.cpp", "#include <vector>\n#include <Eigen/Dense>\n"}, 2, "no mathematics"},
        Break{"LongFile", {"core/a.h", std::string(kMaxLines + 1, '\n')}, kMaxLines + 1, "401 lines"},
        Break{"LongFileWithoutLastNewline", {"core/a.h", std::string(kMaxLines, '\n') + "//"}, kMaxLines + 1, "401 "},
        Break{"OtherExtension", {"core/a.hpp", "#pragma once\n"}, 0, "named .cpp"}),
    [](const auto& instance) { return std::string(instance.param.name); });

class FileAllowance : public ::testing::TestWithParam<SourceFile> {};

TEST_P(FileAllowance, IsGranted) { EXPECT_THAT(check_file(GetParam()), IsEmpty()); }

INSTANTIATE_TEST_SUITE_P(, FileAllowance,
                         ::testing::Values(SourceFile{"solvers/peers/ceres_solver.cpp", "#include <ceres/ceres.h>\n"},
                                           SourceFile{"solvers/weights/nlopt_search.cpp", "#include <nlopt.hpp>\n"},
                                           SourceFile{"runs/a.cpp", "#include \"core/b.h\"\n#include <cmath>\n"},
                                           SourceFile{"core/a.cpp", "// #include \"runs/b.h\"\n"},
                                           SourceFile{"core/a.h", std::string(kMaxLines, '\n')}));

TEST(HouseRules, AskForAHeaderBesideEverySourceOutsideCli) {
  std::vector<SourceFile> files = sound_house();
  files.push_back({"runs/export.cpp", ""});
  files.push_back({"runs/planner.cpp", ""});    // does not extend "plan" by a whole word
  files.push_back({"solvers/plan_b.cpp", ""});  // plan.h is in another folder
  EXPECT_THAT(check_house(files),
              ElementsAre(violation("runs/export.cpp", 0, "no header"), violation("runs/planner.cpp", 0, "no header"),
                          violation("solvers/plan_b.cpp", 0, "no header")));
}

TEST(HouseRules, LetSourcesThatExtendAHeadersNameShareIt) {
  std::vector<SourceFile> files = sound_house();
  files.push_back({"runs/plan_reader.cpp", ""});
  files.push_back({"runs/plan_reader_text.cpp", ""});
  EXPECT_THAT(check_house(files), IsEmpty());
}

TEST(HouseRules, GiveFftwOneUser) {
  std::vector<SourceFile> files = sound_house();
  files.push_back({"core/numerics/second.h", "#include <fftw3.h>\n"});
  EXPECT_THAT(check_house(files), ElementsAre(violation("core/numerics/fourier.cpp", 3, "exactly one"),
                                              violation("core/numerics/second.h", 1, "exactly one")));
  files = sound_house();
  files[1].text = "#include \"core/numerics/fourier.h\"\n";
  EXPECT_THAT(check_house(files), ElementsAre(violation("core", 0, "no file includes FFTW")));
}

TEST(HouseRules, MissAFolderThatIsGone) {
  std::vector<SourceFile> files = sound_house();
  files.pop_back();
  EXPECT_THAT(check_house(files), ElementsAre(violation("cli", 0, "no source file")));
}

TEST(HouseRules, ReportFileAndLine) {
  EXPECT_EQ((Violation{"core/a.h", 3, "why"}.to_string()), "core/a.h:3: why");
  EXPECT_EQ((Violation{"core", 0, "why"}.to_string()), "core: why");
}

}  // namespace
}  // namespace dwell::architecture
