#include "runs/base/made_folders.h"

#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "core/base/errors.h"

namespace dwell {

namespace fs = std::filesystem;

MadeFolders::~MadeFolders() {
  while (!folders_.empty()) folders_.pop_back();
}

void MadeFolders::make(const fs::path& folder, std::size_t most) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path outer = folder; !fs::exists(outer, error) && outer.has_relative_path(); outer = outer.parent_path()) {
    missing.push_back(outer);
  }
  if (missing.size() > most) {
    throw InputError("out", folder.string(), "a folder in one that is there",
                     fmt::format("`out`: neither '{}' nor '{}' is there; the folder and one above it are made, and all "
                                 "of them with `parents`",
                                 missing.back().string(), missing[missing.size() - 2].string()));
  }
  for (auto inner = missing.rbegin(); inner != missing.rend(); ++inner) {
    folders_.emplace_back(UnfinishedOutput::Kind::EmptyFolder, [&] {
      fs::create_directory(*inner, error);
      if (!error) return *inner;
      throw InputError("out", folder.string(), "a folder that can be made",
                       fmt::format("`out`: cannot make the folder '{}': {}", inner->string(), error.message()));
    });
  }
}

}  // namespace dwell
