// Byte sources, bodies in memory and spool, and the threads behind the reactor.

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "api/body_store.h"
#include "api/handler_pool.h"
#include "api/mailbox.h"
#include "core/base/error.h"
#include "tests/api/transport/transport_server.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill::api {
namespace {

TEST(ByteSource, SlicesStayWithinTheirWhole) {
  const auto whole = makeByteSource("0123456789");
  const auto slice = makeSlice(whole, 2, 5);
  EXPECT_EQ(slice->size(), 5U);
  EXPECT_EQ(slice->read(1, 2), "34");
  EXPECT_EQ(slice->read(3, 100), "56");
  EXPECT_EQ(slice->read(5, 1), "");
  EXPECT_EQ(makeSlice(slice, 4, 100)->read(0, 100), "6");
  EXPECT_EQ(makeSlice(whole, 20, 5)->size(), 0U);
}

TEST(ByteSource, ReadingAllHasALimit) {
  EXPECT_EQ(readAll(*makeByteSource("abc"), 3), "abc");
  try {
    readAll(*makeByteSource("abcd"), 3);
    FAIL() << "more than the limit was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kRequestTooLarge);
  }
}

class BodyStoreTest : public ::testing::Test {
 protected:
  BodyStoreTest() {
    options_.spool_folder = folder_.path();
    options_.spool_free_bytes = 0;
    options_.spool_above = 100;
    options_.max_body_memory = 150;
    options_.max_spool_bytes = 1000;
  }
  std::shared_ptr<const ByteSource> store(BodyStore& bodies, std::uint64_t size) const {
    auto buffer = bodies.open(size);
    buffer->append(makePattern(0, size / 2));
    buffer->append(makePattern(size / 2, size - size / 2));
    return buffer->finish();
  }

  TemporaryFolder folder_;
  ServerOptions options_;
};

TEST_F(BodyStoreTest, BodiesComeBackAsTheyWere) {
  BodyStore bodies(options_);
  for (const std::uint64_t size : {0U, 1U, 100U, 101U, 1000U}) {
    const auto body = store(bodies, size);
    EXPECT_EQ(body->size(), size);
    EXPECT_EQ(body->read(0, 2000), makePattern(0, size));
    EXPECT_EQ(body->read(size / 2, 3),
              makePattern(size / 2, std::min<std::size_t>(3, size - size / 2)));
    EXPECT_EQ(body->read(size, 1), "");
  }
}

TEST_F(BodyStoreTest, SpoolFilesHaveNoName) {
  BodyStore bodies(options_);
  const auto body = store(bodies, 500);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(BodyStoreTest, RoomIsGivenBackWithTheBody) {
  BodyStore bodies(options_);
  auto in_memory = store(bodies, 100);
  auto spooled = store(bodies, 900);
  auto also_spooled = store(bodies, 100);  // there are 50 bytes of memory left
  EXPECT_THROW(bodies.open(60), Error);
  in_memory = nullptr;
  EXPECT_NO_THROW(bodies.open(60));
  spooled = nullptr;
  EXPECT_NO_THROW(bodies.open(900));
}

TEST_F(BodyStoreTest, BodiesMayOutliveTheStore) {
  std::shared_ptr<const ByteSource> body;
  {
    BodyStore bodies(options_);
    body = store(bodies, 500);
  }
  EXPECT_EQ(body->read(0, 500), makePattern(0, 500));
}

TEST_F(BodyStoreTest, AMissingFolderIsAFaultOfOurs) {
  options_.spool_folder = "/nowhere/at/all";
  BodyStore bodies(options_);
  try {
    bodies.open(500);
    FAIL() << "a body without a place was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kStorage);
  }
}

TEST(HandlerPool, HeavyTasksLeaveThreadsForQuickOnes) {
  HandlerPool pool(2, 10);
  Latch latch;
  EXPECT_TRUE(pool.submit(HandlerPool::Lane::kHeavy, [&] { latch.wait(); }));
  EXPECT_TRUE(pool.submit(HandlerPool::Lane::kHeavy, [] {}));
  latch.awaitWaiting(1);
  Latch done;
  EXPECT_TRUE(pool.submit(HandlerPool::Lane::kQuick, [&] { done.wait(); }));
  done.awaitWaiting(1);  // it ran while the second heavy one waits
  EXPECT_EQ(pool.queued(), 1U);
  latch.open();
  done.open();
}

TEST(HandlerPool, TheQueueIsBoundedForRequestsOnly) {
  HandlerPool pool(1, 2);
  Latch latch;
  pool.submit(HandlerPool::Lane::kQuick, [&] { latch.wait(); });
  latch.awaitWaiting(1);
  EXPECT_TRUE(pool.submit(HandlerPool::Lane::kQuick, [] {}));
  EXPECT_TRUE(pool.submit(HandlerPool::Lane::kHeavy, [] {}));
  EXPECT_FALSE(pool.submit(HandlerPool::Lane::kQuick, [] {}));
  EXPECT_FALSE(pool.submit(HandlerPool::Lane::kHeavy, [] {}));
  EXPECT_TRUE(pool.submit(HandlerPool::Lane::kContinue, [] {}));
  latch.open();
}

TEST(NoticeLog, ForgottenTopicsCountAsChanged) {
  NoticeLog log;
  log.note({"a", 1});
  EXPECT_TRUE(log.isChangedSince("a", 0));
  EXPECT_FALSE(log.isChangedSince("a", 1));
  EXPECT_FALSE(log.isChangedSince("b", 0));
  for (std::uint64_t i = 2; i < 10'000; ++i) {
    log.note({"t" + std::to_string(i), i});
  }
  EXPECT_TRUE(log.isChangedSince("a", 0));
  EXPECT_FALSE(log.isChangedSince("a", 9'999));
}

TEST(Mailbox, WakesOnceUntilItIsTaken) {
  int wakes = 0;
  Mailbox mailbox([&] { ++wakes; });
  mailbox.put(Topic("a"));
  mailbox.put(Topic("a"));
  mailbox.put(Topic("b"));
  mailbox.put(Answer{});
  EXPECT_EQ(wakes, 1);
  EXPECT_EQ(mailbox.sequence(), 3U);
  std::vector<Notice> notices;
  std::vector<Answer> answers;
  mailbox.take(notices, answers);
  ASSERT_EQ(notices.size(), 2U);
  EXPECT_EQ(notices[0].sequence, 2U);
  EXPECT_EQ(answers.size(), 1U);
  mailbox.put(Topic("a"));
  EXPECT_EQ(wakes, 2);
}

}  // namespace
}  // namespace gaitmill::api
