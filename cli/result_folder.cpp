#include "cli/result_folder.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/places.h"
#include "cli/result_kinds.h"
#include "core/base/errors.h"
#include "core/formats/map_name.h"

namespace dwell::cli {
namespace {

void refuse_to_replace_inputs(const std::string& out, const std::vector<ReadFile>& read) {
  for (const ReadFile& r : read) {
    if (r.file.empty()) continue;
    const std::filesystem::path file = split_map_name(r.file).file;
    std::error_code unknown;
    if (!std::filesystem::exists(file, unknown) || !lies_in(file, out)) continue;
    throw InputError("out", out, "a folder that holds no file that is read",
                     fmt::format("`out`: '{}' holds {} '{}', and is replaced whole; give another folder", out, r.name,
                                 file.string()));
  }
}

}  // namespace

void ResultFolder::add_to(CLI::App& command) {
  command.add_flag("--parents", parents_, "make every missing folder above that of --out; otherwise at most one");
}

OutputFolder ResultFolder::make(const std::string& out, const ResultFiles& files,
                                const std::vector<ReadFile>& read) const {
  if (!out.empty() && is_result(out, files)) refuse_to_replace_inputs(out, read);
  refuse_inside_result(out, files, kinds_of_results());
  return {out, files, parents_ ? MissingParents::MakeAll : MissingParents::MakeOne};
}

}  // namespace dwell::cli
