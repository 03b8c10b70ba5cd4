#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/motion/motion.h"
#include "core/motion/tool_path.h"

namespace dwell::program_cases {

/// A path with no symmetry: three oblique points in line, a corner, a point alone between lifts (a halt), a full
/// reversal.
inline ToolPath winding_path() {
  return {"file",
          {{0.1, -0.2}, {1.3, 0.4}, {2.5, 1.0}, {2.1234567, 3.7}, {-4.0, 2.0}, {6.0, -1.0}, {7.5, -1.0}, {6.25, -1.0}},
          {1, 0, 0, 0, 1, 1, 0, 0}};
}

/// Dwells [s] of the winding path, at least what its strokes take at 50 mm/s; the fourth is just that.
inline std::vector<double> winding_dwells(Motion motion) {
  const std::vector<Stroke> strokes = moving_strokes(winding_path());
  std::vector<double> dwell = {0.5, 1.0 / 3.0, 0.25, strokes[3].length() / 50.0, 2.0, 0.7123456789012, 11.0, 0.125};
  if (motion == Motion::Stop) dwell[3] = 0.0;
  return dwell;
}

inline constexpr double kMaxFeedPerMin = 3000.0;  // 50 mm/s

/// A file of this test alone, removed at the end.
class TestFile {
 public:
  TestFile(const std::string& name, const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              (::testing::UnitTest::GetInstance()->current_test_info()->name() + ("_" + name))) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
  ~TestFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The message of the InputError that `run` throws; a failure and "" if it throws none.
inline std::string input_error(const std::function<void()>& run) {
  try {
    run();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" lacks \"" << part << "\"";
}

/// `text` with its first `from` replaced; a failure if it is not there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "\"" << from << "\" not found";
    return text;
  }
  return text.replace(at, from.size(), to);
}

}  // namespace dwell::program_cases
