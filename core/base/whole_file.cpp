#include "core/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/errors.h"
#include "core/base/staged_files.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_read(const fs::path& file) {
  throw InputError(fmt::format("cannot read '{}': {}", file.string(), std::generic_category().message(errno)));
}

/// What is neither a regular file nor a folder, for messages.
const char* kind_of(mode_t mode) {
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return "neither a file nor a folder";
}

/// A pipe or device may have no end, or wait for ever for a first byte.
void require_regular(const struct stat& status, const fs::path& file) {
  if (S_ISDIR(status.st_mode)) throw InputError(fmt::format("'{}' is a directory; a file is required", file.string()));
  if (!S_ISREG(status.st_mode)) {
    throw InputError(fmt::format("'{}' is {}; a regular file is required", file.string(), kind_of(status.st_mode)));
  }
}

/// Passes the file's bytes to `take` in blocks.
template <class Take>
void for_each_block(const fs::path& file, Take take) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));  // a pipe is not waited for
  if (descriptor.number() < 0) fail_to_read(file);
  struct stat status {};
  if (::fstat(descriptor.number(), &status) != 0) fail_to_read(file);
  require_regular(status, file);
  std::vector<char> block(std::size_t{1} << 20);
  for (;;) {
    const ssize_t count = ::read(descriptor.number(), block.data(), block.size());
    if (count == 0) return;
    if (count > 0) {
      take(std::string_view(block.data(), static_cast<std::size_t>(count)));
    } else if (errno != EINTR) {
      fail_to_read(file);
    }
  }
}

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    require(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  void take(std::string_view bytes) { require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1); }
  std::string hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    require(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1);
    std::string text;
    for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
  }

 private:
  static void require(bool done) {
    if (!done) throw std::runtime_error("SHA-256 failed in the cryptographic library");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string read_whole_file(const fs::path& file) {
  std::string bytes;
  std::error_code unknown;  // what has none is refused below, or grows as it is read
  const std::uintmax_t size = fs::file_size(file, unknown);
  if (!unknown && size < bytes.max_size()) bytes.reserve(static_cast<std::size_t>(size));
  for_each_block(file, [&](std::string_view block) { bytes += block; });
  return bytes;
}

void write_whole_file(const fs::path& file, std::string_view bytes) {
  StagedFiles files;
  files.add(file, bytes);
  files.put_in_place();
}

std::string sha256_of(std::string_view bytes) {
  Sha256 digest;
  digest.take(bytes);
  return digest.hexadecimal();
}

std::string sha256_of_file(const fs::path& file) {
  Sha256 digest;
  for_each_block(file, [&](std::string_view block) { digest.take(block); });
  return digest.hexadecimal();
}

}  // namespace dwell
