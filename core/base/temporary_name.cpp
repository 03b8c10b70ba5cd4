#include "core/base/temporary_name.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace dwell {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".tmp";

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "host";
}

/// ".NAME.HOST-" of a target. A long name is cut: with what follows it must stay below the 255 bytes of a file name.
std::string stem_for(const fs::path& target) {
  constexpr std::size_t kLongest = 160, kLongestHost = 64;
  return fmt::format(".{}.{}-", target.filename().string().substr(0, kLongest), host_name().substr(0, kLongestHost));
}

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

fs::path next_name(const fs::path& target) {
  static std::atomic<unsigned> count{0};  // threads of one process share the pid
  return target.parent_path() / fmt::format("{}{}-{}{}", stem_for(target), ::getpid(), count++, kEnding);
}

/// The process that made the entry of this name for a target of this stem; nothing if it is none of ours.
std::optional<pid_t> maker_of(std::string_view name, std::string_view stem) {
  if (!name.starts_with(stem) || !name.ends_with(kEnding)) return std::nullopt;
  name.remove_prefix(stem.size());
  name.remove_suffix(kEnding.size());
  const char* const end = name.data() + name.size();
  pid_t process = 0;
  unsigned count = 0;
  const auto [dash, error] = std::from_chars(name.data(), end, process);
  if (error != std::errc() || dash == end || *dash != '-') return std::nullopt;
  const auto [last, count_error] = std::from_chars(dash + 1, end, count);
  if (count_error != std::errc() || last != end) return std::nullopt;
  return process;
}

/// Whether nobody works on the entry any more. The lock tells; where the file system has none (folders on NFS), whether
/// the process is still there.
bool is_left(const Descriptor& entry, pid_t maker) {
  if (::flock(entry.number(), LOCK_EX | LOCK_NB) == 0) return true;
  return errno != EWOULDBLOCK && ::kill(maker, 0) != 0 && errno == ESRCH;
}

/// What cannot be looked at or removed stays: it may be somebody else's.
void remove_leftovers(const fs::path& target) {
  const std::string stem = stem_for(target);
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end; entry.increment(error)) {
    const auto maker = maker_of(entry->path().filename().native(), stem);
    if (!maker) continue;
    const Descriptor held(::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (held.number() < 0 || !is_left(held, *maker)) continue;
    fs::remove_all(entry->path(), error);
  }
}

/// Whether the entry has our lock and is still there: between its making and its locking another process may have
/// taken it for a leftover. A file system without locks does not remove it then.
bool is_ours(const TemporaryName& made) {
  if (::flock(made.held.number(), LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
  struct stat held {
  }, named{};
  return ::fstat(made.held.number(), &held) == 0 && ::lstat(made.path.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

/// `open_new` makes the entry of a name and opens it: a descriptor, or -1 with errno.
template <class OpenNew>
TemporaryName make_temporary(const fs::path& target, OpenNew open_new) {
  constexpr int kAttempts = 100;  // more than there are processes that start with the same target at the same moment
  remove_leftovers(target);
  int reason = EEXIST;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const fs::path path = next_name(target);
    TemporaryName made{path, Descriptor(open_new(path.c_str()))};
    reason = made.held.number() < 0 ? errno : EEXIST;
    if (made.held.number() >= 0 && is_ours(made)) return made;
    // A name that an earlier process of this number left, or that was removed under our hands: the next is as good.
    if (reason != EEXIST) break;
  }
  throw std::system_error(reason, std::generic_category());
}

int open_new_file(const char* name) {
  constexpr mode_t kReadWrite = 0666;
  return ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kReadWrite);
}

int open_new_folder(const char* name) {
  constexpr mode_t kAll = 0777;
  if (::mkdir(name, kAll) != 0) return -1;
  const int folder = ::open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int reason = errno == ENOENT ? EEXIST : errno;  // removed by another process that took it for a leftover
  if (folder < 0) ::rmdir(name);
  errno = reason;
  return folder;
}

}  // namespace

TemporaryName make_temporary_file(const fs::path& target) { return make_temporary(target, open_new_file); }
TemporaryName make_temporary_folder(const fs::path& target) { return make_temporary(target, open_new_folder); }

}  // namespace dwell
