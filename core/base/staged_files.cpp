#include "core/base/staged_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "core/base/errors.h"
#include "core/base/temporary_name.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const fs::path& file, const std::string& reason) {
  throw InputError(fmt::format("cannot write '{}': {}", file.string(), reason));
}

[[noreturn]] void fail_to_write(const fs::path& file) { fail_to_write(file, std::generic_category().message(errno)); }

void write_to_disk(int descriptor, std::string_view bytes, const fs::path& file) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      fail_to_write(file);
    }
  }
  if (::fsync(descriptor) != 0) fail_to_write(file);
}

}  // namespace

void StagedFiles::add(const fs::path& file, std::string_view bytes) {
  const auto make = [&](Descriptor& held) {
    try {
      TemporaryName name = make_temporary_file(file);
      held = std::move(name.held);
      return name.path;
    } catch (const std::system_error& error) {
      fail_to_write(file, error.code().message());
    }
  };
  write_to_disk(files_.emplace_back(file, make).held.number(), bytes, file);
}

void StagedFiles::put_in_place() {
  const OutputGroup together;
  for (StagedFile& staged : files_) {
    staged.temporary.put_in_place(staged.file, [&] {
      if (::rename(staged.temporary.path().c_str(), staged.file.c_str()) != 0) fail_to_write(staged.file);
    });
  }
}

}  // namespace dwell
