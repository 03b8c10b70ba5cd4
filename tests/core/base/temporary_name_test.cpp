#include "core/base/temporary_name.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <functional>
#include <set>
#include <system_error>

#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// A process that makes something and then waits to be killed.
class Maker {
 public:
  explicit Maker(const std::function<void()>& make) {
    if (::pipe(made_) != 0) throw std::system_error(errno, std::generic_category());
    child_ = ::fork();
    if (child_ == 0) {
      make();
      (void)!::write(made_[1], "x", 1);
      for (;;) ::pause();
    }
    char word = 0;
    if (::read(made_[0], &word, 1) != 1) throw std::runtime_error("the process made nothing");
  }
  Maker(const Maker&) = delete;
  Maker& operator=(const Maker&) = delete;
  ~Maker() {
    kill();
    ::close(made_[0]);
    ::close(made_[1]);
  }
  void kill() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    child_ = 0;
  }

 private:
  int made_[2] = {-1, -1};
  pid_t child_ = 0;
};

TEST(TemporaryName, IsBesideItsTargetAndNew) {
  const TemporaryFolder folder;
  const TemporaryName a = make_temporary_file(folder.path() / "map.csv"),
                      b = make_temporary_file(folder.path() / "map.csv");
  EXPECT_NE(a.path, b.path);
  for (const TemporaryName* name : {&a, &b}) {
    EXPECT_EQ(name->path.parent_path(), folder.path());
    EXPECT_TRUE(name->path.filename().string().starts_with(".map.csv."));
    EXPECT_TRUE(fs::is_regular_file(name->path));
    EXPECT_EQ(::write(name->held.number(), "x", 1), 1);
  }
  EXPECT_TRUE(fs::is_directory(make_temporary_folder(folder.path() / "plan").path));
}

TEST(TemporaryName, FitsWhereTheTargetsNameJustFits) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(make_temporary_file(folder.path() / std::string(255, 'n')));
  EXPECT_THROW(make_temporary_file(folder.path() / "missing" / "a"), std::system_error);
  EXPECT_THROW(make_temporary_folder(folder.path() / "missing" / "a"), std::system_error);
}

TEST(TemporaryName, OfAKilledProcessGoesWithTheNextForTheSameTarget) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "plan", other = folder.path() / "plan.2";
  Maker maker([&] {
    static const TemporaryName made = make_temporary_folder(target),
                               inner = make_temporary_file(made.path / "feed.csv"), kept = make_temporary_file(other),
                               file = make_temporary_file(target);
  });
  maker.kill();
  ASSERT_EQ(folder.entries(), 3u);
  const TemporaryName mine = make_temporary_folder(target);
  const std::set<std::string> left = names_in(folder.path());
  ASSERT_EQ(left.size(), 2u);
  EXPECT_TRUE(left.contains(mine.path.filename().string()));
  // What was for another target waits for that.
  EXPECT_TRUE(left.begin()->starts_with(".plan.2.") || left.rbegin()->starts_with(".plan.2."));
}

TEST(TemporaryName, OfALivingProcessStays) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "plan";
  Maker maker(
      [&] { static const TemporaryName made = make_temporary_folder(target), file = make_temporary_file(target); });
  {
    const TemporaryName mine = make_temporary_folder(target);
    EXPECT_EQ(folder.entries(), 3u);
  }
  maker.kill();
  const TemporaryName mine = make_temporary_file(target);
  EXPECT_EQ(folder.entries(), 1u);  // of the killed process, and what this one made and let go of
}

TEST(TemporaryName, LeavesWhatOnlyLooksLikeOne) {
  const TemporaryFolder folder;
  const TemporaryName mine = make_temporary_file(folder.path() / "plan");
  const std::string name = mine.path.filename().string();
  const std::string stem = name.substr(0, name.rfind('-', name.rfind('-') - 1) + 1);
  std::set<std::string> kept{name};
  for (const std::string& other : {stem + "1-2.tmp.old", stem + "x-2.tmp", stem + "1.tmp", std::string(".plan.tmp"),
                                   std::string(".plan.otherhost-99999-0.tmp"), std::string("plan")}) {
    ASSERT_NE(other, name);
    folder.file(other, "kept");
    kept.insert(other);
  }
  make_temporary_file(folder.path() / "plan");
  for (const std::string& other : kept) EXPECT_TRUE(fs::exists(folder.path() / other)) << other;
}

}  // namespace
}  // namespace dwell
