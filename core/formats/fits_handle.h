#pragma once

#include <fitsio.h>

#include <cstdlib>
#include <string>

namespace dwell {

/// A FITS file in memory, closed at the end.
class FitsHandle {
 public:
  FitsHandle() = default;
  FitsHandle(const FitsHandle&) = delete;
  FitsHandle& operator=(const FitsHandle&) = delete;
  ~FitsHandle() { close(); }

  fitsfile** out() { return &file_; }
  fitsfile* get() const { return file_; }
  int close() {
    int status = 0;
    if (file_) fits_close_file(file_, &status);
    file_ = nullptr;
    return status;
  }

 private:
  fitsfile* file_ = nullptr;
};

/// What CFITSIO says of a status; empties its stack of messages.
inline std::string fits_message(int status) {
  char text[FLEN_STATUS] = {};
  fits_get_errstatus(status, text);
  fits_clear_errmsg();
  return text;
}

}  // namespace dwell
