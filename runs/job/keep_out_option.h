#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/map/aperture.h"
#include "runs/base/input_file.h"

namespace dwell {

/// The zones of --keep-out: AREA;AREA;..., each an aperture's text or file:NAME, a file with one area a line, in which
/// empty lines and those that begin with # are skipped. Throws InputError naming the part and what is accepted.
void check_keep_out(const std::string& text);

/// The same with other names for the files: what `name` makes of each.
std::string renamed_keep_out(const std::string& text, const std::function<std::string(const std::string&)>& name);

std::vector<std::string> keep_out_files(const std::string& text);

/// All areas; files that are read are appended to `inputs`. Throws InputError, in a file with its line.
std::vector<Aperture> load_keep_out(const std::string& text, std::vector<InputFile>& inputs);

}  // namespace dwell
