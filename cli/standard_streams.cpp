#include "cli/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/base/utf8_text.h"

namespace dwell::cli {

void hold_standard_streams() {
  // A new descriptor has the lowest free number. Nothing can be written to these.
  int number = 0;
  while (number <= STDERR_FILENO) {
    number = ::open("/dev/null", O_RDONLY);
    if (number < 0) return;
  }
  ::close(number);
}

void say(const std::string& text, int patience_ms) {
  if (!is_utf8(text)) return say(with_escaped_bytes(text), patience_ms);
  pollfd error{STDERR_FILENO, POLLOUT, 0};
  if (patience_ms >= 0 && ::poll(&error, 1, patience_ms) == 0) return;
  // This writes past std::cerr, because a thread that is stuck may hold the stream for ever.
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody reads it
}

void print(const std::string& text) {
  // fmt::print would throw as soon as the buffer of the stream overflows, and as an internal fault.
  const std::string shown = is_utf8(text) ? text : with_escaped_bytes(text);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

bool finish_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  const std::string reason = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  say(fmt::format("dwell: cannot write the answer to standard output{}\n", reason));
  return false;
}

}  // namespace dwell::cli
