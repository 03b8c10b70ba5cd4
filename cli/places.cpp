#include "cli/places.h"

#include <algorithm>
#include <system_error>

namespace dwell::cli {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code unknown;
  if (fs::equivalent(a, b, unknown)) return true;
  // Absolute first: of a name that does not exist yet, only that makes "a.png" and "./a.png" the same.
  std::error_code unknown_a, unknown_b;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, unknown_a), unknown_a);
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, unknown_b), unknown_b);
  return unknown_a || unknown_b ? a == b : whole_a == whole_b;
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  std::error_code unknown;
  const fs::path whole = fs::weakly_canonical(fs::absolute(file, unknown), unknown);
  fs::path inside = fs::weakly_canonical(fs::absolute(folder, unknown), unknown);
  if (!inside.has_filename()) inside = inside.parent_path();  // "plan/" is the folder "plan"
  return std::mismatch(inside.begin(), inside.end(), whole.begin(), whole.end()).first == inside.end();
}

}  // namespace dwell::cli
