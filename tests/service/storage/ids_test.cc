#include "service/storage/ids.h"

#include <algorithm>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(MakeId, HasPrefixAndFixedLength) {
  const std::string id = makeId("job_");
  EXPECT_EQ(id.size(), 30U);
  EXPECT_EQ(id.substr(0, 4), "job_");
  EXPECT_EQ(id.find_first_not_of("0123456789abcdefghjkmnpqrstvwxyz", 4), std::string::npos);
}

TEST(MakeId, SortsByTimeOfCreation) {
  std::vector<std::string> ids;
  for (int i = 0; i < 5000; ++i) {
    ids.push_back(makeId("tri_"));
  }
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
}

TEST(MakeId, IsUniqueAcrossThreads) {
  std::vector<std::vector<std::string>> ids(4);
  std::vector<std::thread> threads;
  for (auto& mine : ids) {
    threads.emplace_back([&mine] {
      for (int i = 0; i < 1000; ++i) {
        mine.push_back(makeId(""));
      }
    });
  }
  std::set<std::string> all;
  for (std::size_t i = 0; i < threads.size(); ++i) {
    threads[i].join();
    all.insert(ids[i].begin(), ids[i].end());
  }
  EXPECT_EQ(all.size(), 4000U);
}

}  // namespace
}  // namespace gaitmill
