#include "runs/base/shard.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/errors.h"

namespace dwell {
namespace {

TEST(Shard, EveryTaskIsInExactlyOneOfThem) {
  for (std::size_t count = 1; count <= 9; ++count) {
    for (std::size_t tasks = 0; tasks <= 20; ++tasks) {
      std::multiset<std::size_t> done;
      for (std::size_t number = 1; number <= count; ++number) {
        const Shard shard{number, count};
        for (const std::size_t task : shard.tasks_of(tasks)) {
          EXPECT_TRUE(shard.has(task));
          EXPECT_EQ(task % count, number % count);
          done.insert(task);
        }
      }
      EXPECT_EQ(done.size(), tasks);
      for (std::size_t task = 1; task <= tasks; ++task) EXPECT_EQ(done.count(task), 1U);
    }
  }
}

TEST(Shard, ReadsBackAsItIsWrittenAndRefusesAllElse) {
  EXPECT_EQ(parse_shard("2/5"), (Shard{2, 5}));
  EXPECT_EQ(parse_shard(to_string(Shard{1000000, 1000000})), (Shard{1000000, 1000000}));
  for (const char* text : {"", "/", "2", "2/", "/5", "0/5", "6/5", "-1/5", "1/0", "1/2/3", "1.5/2", " 1/2", "1/2 ",
                           "+1/2", "1/1000001", "99999999999999999999/99999999999999999999", "a/b"}) {
    try {
      parse_shard(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), "shard");
      EXPECT_NE(std::string(error.what()).find("K from 1 to N"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace dwell
