#include "runs/figure/store/run_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) std::strcpy(host.data(), "unknown");
  return fmt::format("process {} on {}", getpid(), host.data());
}

std::string content_of(int file) {
  std::array<char, 512> bytes{};
  const ssize_t n = pread(file, bytes.data(), bytes.size(), 0);
  const std::string_view text(bytes.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  return std::string(trim(text.substr(0, text.find('\n'))));
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& run) {
  const std::filesystem::path lock = run / "lock";
  file_ = Descriptor(open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (file_.number() < 0) {
    throw InputError(fmt::format("{}: the run cannot be changed: {}", lock.string(), std::strerror(errno)));
  }
  if (flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    if (reason != EWOULDBLOCK) {
      throw InputError(fmt::format("{}: the run cannot be locked: {}", lock.string(), std::strerror(reason)));
    }
    const std::string holder = content_of(file_.number());
    throw InputError(fmt::format("{}: the run is being changed by {}; wait until that ends", run.string(),
                                 holder.empty() ? "another process" : holder));
  }
  if (const std::string left = content_of(file_.number()); !left.empty())
    note_ = fmt::format("{} ended while it held the run; its lock is taken over", left);
  const std::string own = this_process() + "\n";
  if (ftruncate(file_.number(), 0) != 0 ||
      pwrite(file_.number(), own.data(), own.size(), 0) != static_cast<ssize_t>(own.size())) {
    throw InputError(fmt::format("{}: cannot write: {}", lock.string(), std::strerror(errno)));
  }
}

RunLock::~RunLock() {
  if (file_.number() >= 0 && ftruncate(file_.number(), 0) != 0) return;  // the next one says that it is taken over
}

}  // namespace dwell
