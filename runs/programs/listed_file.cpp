#include "runs/programs/listed_file.h"

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"

namespace dwell {

std::string listed_bytes(const PvtPlace& at, std::string_view name, std::string_view sha256, const ReadBeside& beside) {
  if (name.empty() || name.find_first_of("/\\:") != std::string_view::npos || name.starts_with('.')) {
    at.fail(fmt::format("file = {}; required the name of a file beside this one", in_quotes(with_escaped_bytes(name))));
  }
  std::string bytes = beside(std::string(name));
  if (const std::string now = sha256_of(bytes); sha256 != now) {
    at.fail(fmt::format("sha256 = {}, but that of {} is {}; required the file that the list was made with",
                        in_quotes(with_escaped_bytes(sha256)), name, now));
  }
  return bytes;
}

}  // namespace dwell
