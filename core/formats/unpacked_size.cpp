#include "core/formats/unpacked_size.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {

void check_unpacked(double rows, double cols, double file_bytes, const PixelLimit& limit, const std::string& what) {
  check_pixels(rows, cols, limit, what);
  const double bytes = rows * cols * sizeof(double);
  if (limit.given || bytes <= kMostUnpacked || bytes <= kMostUnpacking * file_bytes) return;
  throw InputError(fmt::format(
      "{}: {:.0f} x {:.0f} numbers take {:.0f} MB, unpacked from a file of {:.3g} MB; over {:.0f} MB, at most "
      "{:.0f} times the file is accepted: if the file is sound, give `max pixels` {:.0f}",
      what, rows, cols, bytes * 1e-6, file_bytes * 1e-6, kMostUnpacked * 1e-6, kMostUnpacking, rows * cols));
}

}  // namespace dwell
