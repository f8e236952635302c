#include "service/idempotency_service.h"

#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

class IdempotencyServiceTest : public ::testing::Test {
 protected:
  api::IdempotencyPort& port() { return fixture_.ports().idempotency; }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab", "key_1");
};

TEST_F(IdempotencyServiceTest, FirstAnswerIsKeptForTheKeyOfItsTenantAndApiKey) {
  EXPECT_FALSE(port().begin(who_, "monday", "hash"));
  EXPECT_EQ(port().begin(who_, "monday", "hash")->status, 0) << "still being answered";
  port().finish(who_, "monday", {"hash", 201, "application/json", "/v1/trials/x", "{}"});
  const auto kept = port().begin(who_, "monday", "other hash");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->request_hash, "hash");
  EXPECT_EQ(kept->status, 201);
  EXPECT_EQ(kept->location, "/v1/trials/x");
  EXPECT_FALSE(port().begin(makeMember("gait lab", "key_2"), "monday", "hash"));
  EXPECT_FALSE(port().begin(makeMember("other", "key_1"), "monday", "hash"));
}

TEST_F(IdempotencyServiceTest, AbandonedKeyMayBeTakenAgain) {
  EXPECT_FALSE(port().begin(who_, "monday", "hash"));
  port().abandon(who_, "monday");
  EXPECT_FALSE(port().begin(who_, "monday", "hash"));
}

TEST_F(IdempotencyServiceTest, RequestThatARestartCutOffMayBeRepeated) {
  EXPECT_FALSE(port().begin(who_, "monday", "hash"));
  port().finish(who_, "monday", {"hash", 201, "", "", ""});
  EXPECT_FALSE(port().begin(who_, "tuesday", "hash"));
  fixture_.reopen();
  EXPECT_EQ(port().begin(who_, "monday", "hash")->status, 201);
  EXPECT_FALSE(port().begin(who_, "tuesday", "hash"));
}

TEST_F(IdempotencyServiceTest, OfConcurrentRequestsExactlyOneRuns) {
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> runs{0};
    std::vector<std::thread> clients;
    for (int i = 0; i < 8; ++i) {
      clients.emplace_back([&, key = "round " + std::to_string(round)] {
        if (!port().begin(who_, key, "hash")) {
          ++runs;
        }
      });
    }
    for (std::thread& client : clients) {
      client.join();
    }
    EXPECT_EQ(runs, 1);
  }
}

}  // namespace
}  // namespace gaitmill
