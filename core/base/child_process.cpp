#include "core/base/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/memory.h"

namespace dwell {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(fmt::format("cannot {}: {}", what, std::generic_category().message(errno)));
}

bool write_all(int descriptor, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(descriptor, bytes, size);
    if (count < 0 && errno != EINTR) return false;
    if (count < 0) continue;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

void limit(decltype(RLIMIT_CPU) resource, rlim_t most) {
  const rlimit limits{most, most};
  ::setrlimit(resource, &limits);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// A crash is an answer here: no handler of the host program, no core file, no words on the terminal. The copy ends
/// with its original, which may be ended while it waits for the answer.
void be_quiet(const ChildLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
  // What a terminal sends to all of a group is for the original to answer: a copy that ended of it would look like a
  // corrupt file.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::max(1.0, std::round(limits.cpu_seconds))));
  if (!kSanitized) limit(RLIMIT_AS, address_space_in_use() + limits.bytes);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
}

/// Ends the copy without what a program does at its end, which is for the original to do.
[[noreturn]] void run_child(const std::function<void(const AnswerSink&)>& work, int answer, const ChildLimits& limits) {
  be_quiet(limits);
  std::size_t size = 0;
  work([&](std::string_view bytes) {
    if (!write_all(answer, bytes.data(), bytes.size())) ::_exit(1);
    size += bytes.size();
  });
  // The size comes last: whoever reads it knows that all before it is there.
  ::_exit(write_all(answer, reinterpret_cast<const char*>(&size), sizeof size) ? 0 : 1);
}

/// The answer without its size at the end; nothing unless it is whole.
std::optional<ChildAnswer> whole_answer(int descriptor) {
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  std::size_t size = 0;
  if (end < static_cast<off_t>(sizeof size)) return std::nullopt;
  const off_t before = end - static_cast<off_t>(sizeof size);
  if (::pread(descriptor, &size, sizeof size, before) != static_cast<ssize_t>(sizeof size)) return std::nullopt;
  if (size != static_cast<std::size_t>(before)) return std::nullopt;
  if (size == 0) return ChildAnswer(nullptr, 0);
  void* bytes = ::mmap(nullptr, size, PROT_READ, MAP_SHARED | MAP_POPULATE, descriptor, 0);
  if (bytes == MAP_FAILED) fail("map the answer of a process");
  return ChildAnswer(bytes, size);
}

}  // namespace

ChildAnswer::ChildAnswer(ChildAnswer&& other) noexcept
    : bytes_(std::exchange(other.bytes_, nullptr)), size_(std::exchange(other.size_, 0)) {}

ChildAnswer::~ChildAnswer() {
  if (bytes_) ::munmap(bytes_, size_);
}

std::optional<ChildAnswer> output_of_child(const std::function<void(const AnswerSink&)>& work,
                                           const ChildLimits& limits) {
  // A file in memory rather than a pipe: the copy never waits for a reader, and the reader only for its end.
  const Descriptor answer(::memfd_create("dwell", MFD_CLOEXEC));
  if (answer.number() < 0) fail("make a file in memory");
  const pid_t child = ::fork();
  if (child < 0) fail("start a process");
  if (child == 0) run_child(work, answer.number(), limits);
  int status = 0;
  // Nobody to wait for is no fault: the host program may have asked for its children to vanish. The answer tells.
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return whole_answer(answer.number());
}

}  // namespace dwell
