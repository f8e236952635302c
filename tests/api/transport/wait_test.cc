// Long polls, event streams, and the end of the server.

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/api/transport/transport_server.h"

namespace gaitmill::api {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class WaitTest : public TransportTest {
 protected:
  static ServerOptions makeOptions() {
    ServerOptions options;
    options.threads = 2;
    options.ask_again = seconds(60);  // so that only notices are seen
    return options;
  }
  bool awaitParked(std::size_t count) {
    return server().awaitLoad([count](const ServerLoad& load) { return load.parked == count; });
  }
  bool awaitStreams(std::size_t count) {
    return server().awaitLoad(
        [count](const ServerLoad& load) { return load.event_streams == count; });
  }
};

TEST_F(WaitTest, ANoticeEndsALongPoll) {
  start(makeOptions());
  RawClient client = connect();
  client.send(makeGet("/wait?ms=60000") + makeGet("/livez"));
  ASSERT_TRUE(awaitParked(1));
  state().is_final = true;
  server().server().notify("job_1");
  EXPECT_EQ(client.read().body, "final");
  EXPECT_EQ(client.read().body, "ok");  // what was sent behind it has waited
  EXPECT_EQ(server().server().load().parked, 0U);
}

TEST_F(WaitTest, NoticesOfOthersOrWithoutEffectKeepWaiting) {
  start(makeOptions());
  RawClient client = connect();
  client.send(makeGet("/wait?ms=60000"));
  ASSERT_TRUE(awaitParked(1));
  server().server().notify("job_2");
  server().server().notify("job_1");
  while (state().asked < 2) {
    std::this_thread::yield();
  }
  EXPECT_FALSE(client.isClosedWithin(milliseconds(50)));
  EXPECT_EQ(state().asked, 2);
}

TEST_F(WaitTest, ALongPollAnswersWhenItsTimeIsOver) {
  start(makeOptions());
  EXPECT_EQ(ask(makeGet("/wait?ms=50")).body, "running");
  EXPECT_EQ(ask(makeGet("/wait?ms=0")).body, "running");
}

TEST_F(WaitTest, ChangesWithoutNoticeAreFoundByAskingAgain) {
  ServerOptions options = makeOptions();
  options.ask_again = milliseconds(20);
  start(options);
  RawClient client = connect();
  client.send(makeGet("/wait?ms=60000"));
  ASSERT_TRUE(awaitParked(1));
  state().is_final = true;
  EXPECT_EQ(client.read().body, "final");
}

// Twenty times as many as there are handler threads.
TEST_F(WaitTest, ManyLongPollsHoldNoThread) {
  start(makeOptions());
  std::vector<RawClient> clients;
  for (int i = 0; i < 40; ++i) {
    clients.push_back(connect());
    clients.back().send(makeGet("/wait?ms=60000"));
  }
  ASSERT_TRUE(awaitParked(40));
  EXPECT_EQ(ask(makeGet("/livez")).status, 200);
  state().is_final = true;
  server().server().notify("job_1");
  for (RawClient& client : clients) {
    EXPECT_EQ(client.read().body, "final");
  }
}

TEST_F(WaitTest, ClientsThatLeaveALongPollAreForgotten) {
  start(makeOptions());
  RawClient client = connect();
  client.send(makeGet("/wait?ms=60000"));
  ASSERT_TRUE(awaitParked(1));
  client.close();
  EXPECT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 0; }));
}

// A change between the handler's look and the parking must not be slept through.
TEST_F(WaitTest, NoNoticeIsLostOnTheWayToParking) {
  start(makeOptions());
  for (int round = 0; round < 200; ++round) {
    state().is_final = false;
    RawClient client = connect();
    client.send(makeGet("/wait?ms=60000"));
    std::this_thread::sleep_for(std::chrono::microseconds(round * 2));
    state().is_final = true;
    server().server().notify("job_1");
    ASSERT_EQ(client.read().body, "final") << round;
  }
}

TEST_F(WaitTest, EventsArriveAsTheyHappen) {
  start(makeOptions());
  state().addEvent("one");
  RawClient client = connect();
  client.send(makeGet("/events"));
  const RawReply head = client.readHead();
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.header("content-type"), "text/event-stream");
  EXPECT_EQ(head.headers.count("content-length"), 0U);
  EXPECT_EQ(client.readUntil("\n\n"), "data: one\n\n");
  for (const char* event : {"two", "three"}) {
    state().addEvent(event);
    server().server().notify("job_1");
    EXPECT_EQ(client.readUntil("\n\n"), std::string("data: ") + event + "\n\n");
  }
  state().addEvent("end");
  server().server().notify("job_1");
  EXPECT_EQ(client.readToEnd(), "data: end\n\n");
}

TEST_F(WaitTest, EventStreamsHaveAPulseAndALimit) {
  ServerOptions options = makeOptions();
  options.max_event_streams = 3;
  options.stream_pulse = milliseconds(50);
  start(options);
  std::vector<RawClient> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(connect());
    clients.back().send(makeGet("/events"));
    EXPECT_EQ(clients.back().readHead().status, 200);
  }
  ASSERT_TRUE(awaitStreams(3));
  const RawReply refused = ask(makeGet("/events"));
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.header("retry-after"), "");
  EXPECT_EQ(clients[0].readUntil("\n\n"), ": still here\n\n");
  clients.clear();
  EXPECT_TRUE(awaitStreams(0));
  RawClient again = connect();
  again.send(makeGet("/events"));
  EXPECT_EQ(again.readHead().status, 200);
}

TEST_F(WaitTest, HeadOfAnEventStreamEndsAtOnce) {
  start(makeOptions());
  RawClient client = connect();
  client.send("HEAD /events HTTP/1.1\r\nHost: a\r\n\r\n");
  EXPECT_EQ(client.readHead().header("content-type"), "text/event-stream");
  EXPECT_EQ(client.readToEnd(), "");
  EXPECT_EQ(state().asked, 0);
}

TEST_F(WaitTest, ManyEventsReachASlowReader) {
  ServerOptions options = makeOptions();
  options.ask_again = milliseconds(20);
  start(options);
  RawClient client = connect();
  client.send(makeGet("/events"));
  const std::string event(10'000, 'e');
  for (int i = 0; i < 1000; ++i) {
    state().addEvent(event);
    server().server().notify("job_1");
  }
  state().addEvent("end");
  client.readHead();
  const std::string all = client.readToEnd();
  EXPECT_EQ(all.size(), 1000 * (event.size() + 8) + 11);
}

// --- the end ---

TEST_F(WaitTest, StopAnswersWhatIsUnderWayAndClosesTheRest) {
  start(makeOptions());
  RawClient idle = connect();
  RawClient partial = connect();
  partial.send("GET /livez HTTP/1.1\r\n");
  RawClient uploading = connect();
  uploading.send("PUT /bytes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 900\r\n\r\n");
  RawClient streaming = connect();
  streaming.send(makeGet("/events"));
  EXPECT_EQ(streaming.readHead().status, 200);
  RawClient parked = connect();
  parked.send(makeGet("/wait?ms=60000"));
  ASSERT_TRUE(awaitParked(1));
  RawClient held = connect();
  held.send(makeGet("/held"));
  state().latch.awaitWaiting(1);
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 6; }));
  server().server().stop();
  EXPECT_EQ(parked.read().body, "running");
  EXPECT_EQ(uploading.read().status, 503);
  EXPECT_EQ(streaming.readToEnd(), "");
  EXPECT_TRUE(idle.isClosedWithin(seconds(10)));
  EXPECT_TRUE(partial.isClosedWithin(seconds(10)));
  state().latch.open();
  const RawReply last = held.read();
  EXPECT_EQ(last.body, "released");
  EXPECT_EQ(last.header("connection"), "close");
  server().stop();
  EXPECT_FALSE(connect().isConnected());
}

TEST_F(WaitTest, StopDoesNotWaitForClientsThatDoNotRead) {
  ServerOptions options = makeOptions();
  options.stop_limit = milliseconds(200);
  start(options);
  RawClient client = connect();
  client.send(makeGet("/large"));
  EXPECT_EQ(client.readHead().status, 200);
  const auto begin = std::chrono::steady_clock::now();
  server().stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(10));
}

TEST_F(WaitTest, AServerStoppedBeforeItRunsDoesNotRun) {
  TransportState unused;
  Server early(makeTransportRoutes(unused), {}, [](LogLevel, const std::string&) {});
  early.bind();
  early.stop();
  early.run();
}

TEST_F(WaitTest, APortInUseIsAnError) {
  start(makeOptions());
  ServerOptions options;
  options.port = server().port();
  TransportState unused;
  Server second(makeTransportRoutes(unused), options, [](LogLevel, const std::string&) {});
  try {
    second.bind();
    FAIL() << "two servers share a port";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kServicePort);
  }
}

}  // namespace
}  // namespace gaitmill::api
