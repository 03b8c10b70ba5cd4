#include "core/base/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

TEST(WholeFile, ReadsBackWhatItWrote) {
  const test::TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_whole_file(folder.path() / "a.bin", "earlier");
  write_whole_file(folder.path() / "a.bin", bytes);
  EXPECT_EQ(read_whole_file(folder.path() / "a.bin"), bytes);
  EXPECT_EQ(folder.entries(), 1u);
  write_whole_file(folder.path() / "empty", "");
  EXPECT_EQ(read_whole_file(folder.path() / "empty"), "");
}

TEST(WholeFile, ReadsMoreThanOneBlock) {
  const test::TemporaryFolder folder;
  std::string bytes(3'000'001, 'x');
  bytes[2'999'999] = 'y';
  write_whole_file(folder.path() / "big", bytes);
  EXPECT_EQ(read_whole_file(folder.path() / "big"), bytes);
}

TEST(WholeFile, NamesWhatItCannotReadOrWrite) {
  const test::TemporaryFolder folder;
  const std::filesystem::path missing = folder.path() / "missing", inside = folder.path() / "no" / "such" / "file";
  test::expect_input_error([&] { read_whole_file(missing); }, {missing.string(), "No such file"});
  test::expect_input_error([&] { read_whole_file(folder.path()); }, {folder.path().string(), "directory"});
  test::expect_input_error([&] { sha256_of_file(missing); }, {missing.string(), "No such file"});
  test::expect_input_error([&] { write_whole_file(inside, "x"); }, {inside.string(), "No such file"});
}

TEST(WholeFile, RefusesPipesAndDevicesAtOnce) {
  const test::TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  test::expect_input_error([&] { read_whole_file(pipe); }, {pipe.string(), "is a pipe; a regular file is required"});
  test::expect_input_error([&] { sha256_of_file(pipe); }, {pipe.string(), "is a pipe; a regular file is required"});
  test::expect_input_error([] { read_whole_file("/dev/zero"); }, {"'/dev/zero' is a device; a regular file"});
}

TEST(WholeFile, AFailedWriteLeavesNothingBehind) {
  const test::TemporaryFolder folder;
  const std::filesystem::path target = folder.path() / "target";
  std::filesystem::create_directory(target);  // a file cannot be renamed onto a directory
  test::expect_input_error([&] { write_whole_file(target, "x"); }, {target.string(), "directory"});
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_TRUE(std::filesystem::is_directory(target));
}

TEST(WholeFile, Sha256OfKnownMessages) {
  // FIPS 180-2, appendix B.1 and B.3, and the digest of the empty message.
  const test::TemporaryFolder folder;
  EXPECT_EQ(sha256_of_file(folder.file("abc", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_file(folder.file("million", std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256_of_file(folder.file("empty", "")),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace dwell
