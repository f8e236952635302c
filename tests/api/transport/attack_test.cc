// Hostile clients: each attack with the answer it gets, and the service lives on. cpp-httplib 0.11
// has no defence of its own against most of these.

#include <dirent.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "api/listener.h"
#include "tests/api/transport/transport_server.h"

namespace gaitmill::api {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

std::string repeat(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) {
    all += text;
  }
  return all;
}

struct Attack {
  const char* name;
  std::string bytes;
  int status;        // of the first answer
  const char* code;  // of its problem
};

std::string get(const std::string& headers) {
  return makeGet("/items/a", headers);
}

// A JSON request with these headers in place of a good Content-Length.
std::string post(const std::string& headers, const std::string& body = "") {
  return "POST /json HTTP/1.1\r\nHost: test\r\nContent-Type: application/json\r\n" + headers +
         "\r\n" + body;
}

std::string upload(const std::string& type, const std::string& body) {
  return makeRequest("POST", "/parts", "multipart/form-data" + type, body);
}

const std::string kPart = "--x\r\nContent-Disposition: form-data; name=\"a\"\r\n\r\nb\r\n";

std::vector<Attack> listHeadAttacks() {
  constexpr const char* kBad = "request.malformed";
  constexpr const char* kBig = "request.headers_too_large";
  return {
      {"noise", std::string(300, '\x01'), 400, kBad},
      {"TLS on a plain port", std::string("\x16\x03\x01\x02\x00\x01\x00", 7), 400, kBad},
      {"HTTP/2", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 400, kBad},
      {"HTTP/0.9", "GET /livez\r\n\r\n", 400, kBad},
      {"unknown version", "GET /livez HTTP/1.9\r\nHost: a\r\n\r\n", 400, kBad},
      {"no host", "GET /livez HTTP/1.1\r\n\r\n", 400, kBad},
      {"two hosts", "GET /livez HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", 400, kBad},
      {"two spaces", "GET  /livez HTTP/1.1\r\nHost: a\r\n\r\n", 400, kBad},
      {"tab as space", "GET\t/livez HTTP/1.1\r\nHost: a\r\n\r\n", 400, kBad},
      {"bare line feeds", "GET /livez HTTP/1.1\nHost: a\n\n", 400, kBad},
      {"bare line feed in a header", get("A: b\nB: c\r\n"), 400, kBad},
      {"bare carriage return", get("A: b\rB: c\r\n"), 400, kBad},
      {"folded header", get("A: b\r\n c\r\n"), 400, kBad},
      {"space before the colon", get("Content-Length : 5\r\n"), 400, kBad},
      {"header without colon", get("nothing\r\n"), 400, kBad},
      {"header without name", get(": b\r\n"), 400, kBad},
      {"NUL in a value", get(std::string("A: b\0c\r\n", 8)), 400, kBad},
      {"NUL in a name", get(std::string("A\0: b\r\n", 7)), 400, kBad},
      {"NUL in the path", std::string("GET /a\0b HTTP/1.1\r\nHost: a\r\n\r\n", 31), 400, kBad},
      {"path with a fragment", makeGet("/livez#a"), 400, kBad},
      {"proxy request", "CONNECT other:443 HTTP/1.1\r\nHost: a\r\n\r\n", 400, kBad},
      {"endless method", std::string(100, 'A') + " / HTTP/1.1\r\nHost: a\r\n\r\n", 400, kBad},
      {"long path", makeGet("/" + std::string(5000, 'a')), 414, "request.uri_too_long"},
      {"endless path", "GET /" + std::string(5000, 'a'), 414, "request.uri_too_long"},
      {"long query", makeGet("/livez?" + repeat("a=b&", 800)), 414, "request.uri_too_long"},
      {"endless header line", "GET /livez HTTP/1.1\r\nA: " + std::string(70'000, 'a'), 431, kBig},
      {"many headers", get(repeat("A: b\r\n", 200)), 431, kBig},
      {"many bytes of headers",
       get(repeat("A: " + std::string(1000, 'b') + "\r\n", 20)),
       431,
       kBig},
  };
}

std::vector<Attack> listLengthAttacks() {
  constexpr const char* kBad = "request.malformed";
  constexpr const char* kLength = "request.length_required";
  constexpr const char* kType = "request.media_type";
  return {
      {"chunked", post("Transfer-Encoding: chunked\r\n", "2\r\n{}\r\n0\r\n\r\n"), 411, kLength},
      {"chunked to a GET", get("Transfer-Encoding: chunked\r\n"), 411, kLength},
      {"hidden chunked", post("Transfer-Encoding: \tchunked\r\n"), 411, kLength},
      {"unknown transfer encoding", post("Transfer-Encoding: x, chunked\r\n"), 411, kLength},
      {"CL.TE", post("Content-Length: 2\r\nTransfer-Encoding: chunked\r\n", "{}"), 400, kBad},
      {"TE.CL", post("Transfer-Encoding: chunked\r\nContent-Length: 2\r\n", "{}"), 400, kBad},
      {"TE twice", post("Transfer-Encoding: a\r\nTransfer-Encoding: chunked\r\n"), 400, kBad},
      {"chunked before 1.1",
       "GET /livez HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n",
       400,
       kBad},
      {"two lengths", post("Content-Length: 2\r\nContent-Length: 40\r\n", "{}"), 400, kBad},
      {"the same length twice",
       post("Content-Length: 2\r\nContent-Length: 2\r\n", "{}"),
       400,
       kBad},
      {"list of lengths", post("Content-Length: 2, 2\r\n", "{}"), 400, kBad},
      {"length with sign", post("Content-Length: +2\r\n", "{}"), 400, kBad},
      {"negative length", post("Content-Length: -1\r\n", "{}"), 400, kBad},
      {"hexadecimal length", post("Content-Length: 0x2\r\n", "{}"), 400, kBad},
      {"empty length", post("Content-Length:\r\n", "{}"), 400, kBad},
      {"overflowing length", post("Content-Length: 18446744073709551618\r\n"), 400, kBad},
      {"no length", post(""), 411, kLength},
      {"large length", post("Content-Length: 1000000000\r\n"), 413, "request.too_large"},
      {"large upload",
       "PUT /bytes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 99999999999\r\n\r\n",
       413,
       "request.too_large"},
      {"gzip bomb", post("Content-Length: 2\r\nContent-Encoding: gzip\r\n", "{}"), 415, kType},
      {"brotli", post("Content-Length: 2\r\nContent-Encoding: br\r\n", "{}"), 415, kType},
      {"two types", post("Content-Type: text/plain\r\nContent-Length: 2\r\n", "{}"), 400, kBad},
      {"another type", makeRequest("POST", "/json", "text/plain", "{}"), 415, kType},
      {"JSON where parts are wanted",
       makeRequest("POST", "/parts", "application/json", "{}"),
       415,
       kType},
      {"unknown expectation", post("Content-Length: 2\r\nExpect: wonders\r\n", "{}"), 400, kBad},
  };
}

std::vector<Attack> listMultipartAttacks() {
  constexpr const char* kBad = "request.malformed";
  const std::string headers = "--x\r\nContent-Disposition: form-data; name=\"a\"\r\n";
  return {
      {"no boundary", upload("", kPart + "--x--"), 400, kBad},
      {"empty boundary", upload("; boundary=", kPart + "--x--"), 400, kBad},
      {"quoted empty boundary", upload("; boundary=\"\"", kPart + "--x--"), 400, kBad},
      {"long boundary", upload("; boundary=" + std::string(71, 'x'), "--x--"), 400, kBad},
      {"strange boundary", upload("; boundary=\"x\x7f\"", "--x--"), 400, kBad},
      {"unended boundary", upload("; boundary=\"x", "--x--"), 400, kBad},
      {"no parts", upload("; boundary=x", "--x--\r\n"), 400, kBad},
      {"another boundary", upload("; boundary=x", "--y\r\nA: b\r\n\r\nb\r\n--y--"), 400, kBad},
      {"no final boundary", upload("; boundary=x", kPart), 400, kBad},
      {"cut in a boundary", upload("; boundary=x", kPart + "--"), 400, kBad},
      {"cut in headers", upload("; boundary=x", "--x\r\nContent-Disposition: form-"), 400, kBad},
      {"part without headers", upload("; boundary=x", "--x\r\n\r\nb\r\n--x--"), 400, kBad},
      {"part without name", upload("; boundary=x", "--x\r\nA: b\r\n\r\nb\r\n--x--"), 400, kBad},
      {"empty name",
       upload("; boundary=x", "--x\r\nContent-Disposition: form-data; name=\"\"\r\n\r\nb\r\n--x--"),
       400,
       kBad},
      {"unended name",
       upload("; boundary=x", "--x\r\nContent-Disposition: form-data; name=\"a\r\n\r\nb\r\n--x--"),
       400,
       kBad},
      {"two names",
       upload("; boundary=x",
              headers + "Content-Disposition: form-data; name=\"b\"\r\n\r\nb\r\n--x--"),
       400,
       kBad},
      {"word behind a boundary", upload("; boundary=x", kPart + "--xy\r\n\r\n--x--"), 400, kBad},
      {"many parts", upload("; boundary=x", repeat(kPart, 200) + "--x--"), 400, kBad},
      {"long part headers",
       upload("; boundary=x", headers + "A: " + std::string(100'000, 'b') + "\r\n\r\nb\r\n--x--"),
       400,
       kBad},
  };
}

std::vector<Attack> listPathAttacks() {
  constexpr const char* kNone = "request.not_found";
  return {
      {"traversal", makeGet("/items/../../etc/passwd"), 404, kNone},
      {"dots as a name", makeGet("/items/.."), 404, kNone},
      {"encoded traversal", makeGet("/items/..%2f..%2fetc"), 404, kNone},
      {"encoded slash", makeGet("/items%2Fa"), 404, kNone},
      {"encoded backslash", makeGet("/items/a%5Cb"), 404, kNone},
      {"encoded NUL", makeGet("/items/a%00"), 404, kNone},
      {"encoded line end", makeGet("/items/a%0d%0aB"), 404, kNone},
      {"long name", makeGet("/items/" + std::string(101, 'a')), 404, kNone},
  };
}

class AttackTest : public TransportTest {
 protected:
  AttackTest() { start(); }

  void expectRefused(const std::vector<Attack>& attacks) {
    for (const Attack& attack : attacks) {
      RawClient client = connect();
      client.send(attack.bytes);
      const RawReply reply = client.read();
      EXPECT_EQ(reply.status, attack.status) << attack.name;
      EXPECT_NE(reply.body.find(attack.code), std::string::npos) << attack.name << reply.body;
      EXPECT_EQ(ask(makeGet("/livez")).status, 200) << "after " << attack.name;
    }
    EXPECT_EQ(state().calls, 0);
  }
};

TEST_F(AttackTest, BadHeadsAreRefused) {
  expectRefused(listHeadAttacks());
}

TEST_F(AttackTest, BadLengthsAndEncodingsAreRefusedBeforeTheBody) {
  expectRefused(listLengthAttacks());
}

TEST_F(AttackTest, BadMultipartIsRefused) {
  expectRefused(listMultipartAttacks());
}

TEST_F(AttackTest, PathsLeadNowhereElse) {
  expectRefused(listPathAttacks());
}

// What stands behind a refused head may be its body: it must not be served as a request.
TEST_F(AttackTest, RefusedBodiesAreNotServedAsRequests) {
  const std::string hidden = makeGet("/items/smuggled");
  const std::string length = "Content-Length: " + std::to_string(hidden.size()) + "\r\n";
  for (const std::string& request :
       {"POST /nowhere HTTP/1.1\r\nHost: a\r\n" + length + "\r\n" + hidden,
        "POST /json HTTP/1.1\r\nHost: a\r\nContent-Type: text/plain\r\n" + length + "\r\n" + hidden,
        post("Transfer-Encoding: chunked\r\n", "0\r\n\r\n" + hidden),
        post("Transfer-Encoding: chunked\r\n" + length, hidden),
        post("Content-Length: 0\r\n" + length, hidden),
        get("A: b\r\n c\r\n") + hidden,
        "OPTIONS /json HTTP/1.1\r\nHost: a\r\n" + length + "\r\n" + hidden,
        "GET /livez HTTP/1.1\r\nHost: a\r\n" + length + "\r\n" + hidden}) {
    RawClient client = connect();
    client.send(request);
    client.endSending();
    EXPECT_EQ(client.readToEnd().find("smuggled"), std::string::npos) << request;
  }
  EXPECT_EQ(state().calls, 0);
}

// Hundreds of overlapping ranges would multiply a reply.
TEST_F(AttackTest, ManyRangesGetOneWholeReply) {
  const RawReply reply = ask(makeGet("/table", "Range: bytes=" + repeat("0-,", 500) + "0-\r\n"));
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body.size(), 20'002U);
}

TEST_F(AttackTest, RefusedUploadsCanReadWhyWhileTheyStillSend) {
  RawClient client = connect();
  client.send("PUT /nowhere HTTP/1.1\r\nHost: a\r\nContent-Length: 50000000\r\n\r\n");
  client.send(std::string(8'000'000, 'x'));
  EXPECT_EQ(client.read().status, 404);
}

// --- slow clients ---

class SlowTest : public TransportTest {
 protected:
  static ServerOptions makeImpatient() {
    ServerOptions options;
    options.keep_alive = milliseconds(300);
    options.header_deadline = milliseconds(300);
    options.body_deadline = milliseconds(300);
    options.reply_deadline = milliseconds(300);
    options.lowest_rate = 100'000;
    return options;
  }
};

TEST_F(SlowTest, SlowHeadersAreTimedOut) {
  start(makeImpatient());
  RawClient client = connect();
  client.send("GET /livez HTTP/1.1\r\nA:");
  const RawReply reply = client.read();
  EXPECT_EQ(reply.status, 408);
  EXPECT_NE(reply.body.find("request.timeout"), std::string::npos);
}

// A byte now and then would reset a time-out per read for ever.
TEST_F(SlowTest, DrippedHeadersAndBodiesAreTimedOut) {
  start(makeImpatient());
  for (const std::string& begin :
       {std::string("GET /livez HTTP/1.1\r\nA: "),
        std::string("PUT /bytes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 900000\r\n\r\n")}) {
    RawClient client = connect();
    client.send(begin);
    const auto until = std::chrono::steady_clock::now() + seconds(20);
    while (std::chrono::steady_clock::now() < until && !client.isClosedWithin(milliseconds(20)) &&
           client.send("a")) {
    }
    EXPECT_LT(std::chrono::steady_clock::now(), until) << begin;
  }
}

TEST_F(SlowTest, SlowBodiesAreTold) {
  start(makeImpatient());
  RawClient client = connect();
  client.send(post("Content-Length: 100\r\n", "{"));
  EXPECT_EQ(client.read().status, 408);
  EXPECT_TRUE(client.isClosedWithin(seconds(10)));
}

TEST_F(SlowTest, IdleConnectionsAreClosed) {
  start(makeImpatient());
  RawClient silent = connect();
  RawClient used = connect();
  used.send(makeGet("/livez"));
  EXPECT_EQ(used.read().status, 200);
  EXPECT_TRUE(silent.isClosedWithin(seconds(10)));
  EXPECT_TRUE(used.isClosedWithin(seconds(10)));
}

TEST_F(SlowTest, ClientsThatDoNotReadAreDropped) {
  start(makeImpatient());
  RawClient client = connect();
  client.send(makeGet("/large") + makeGet("/large"));
  EXPECT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 0; }));
}

TEST_F(SlowTest, ReadersAtTheirPaceGetAll) {
  ServerOptions options = makeImpatient();
  options.reply_deadline = seconds(30);
  start(options);
  RawClient client = connect();
  client.send(makeGet("/large"));
  EXPECT_EQ(client.readHead().status, 200);
  std::string body;
  while (body.size() < kLargeBytes) {
    const std::string piece = client.readSome(50'000);
    ASSERT_FALSE(piece.empty());
    body += piece;
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE(body == makePattern(0, kLargeBytes));
}

// --- crowds ---

std::size_t countDescriptors() {
  std::size_t count = 0;
  DIR* folder = ::opendir("/proc/self/fd");
  while (::readdir(folder) != nullptr) {
    ++count;
  }
  ::closedir(folder);
  return count;
}

class CrowdTest : public TransportTest {
 protected:
  std::vector<RawClient> connectMany(int count, const std::string& bytes) const {
    std::vector<RawClient> clients;
    for (int i = 0; i < count; ++i) {
      clients.push_back(connect());
      clients.back().send(bytes);
    }
    return clients;
  }
};

TEST_F(CrowdTest, ThousandsOfIdleAndDrippingClientsDoNotKeepOthersWaiting) {
  ASSERT_GE(raiseFileLimit(10'000), 10'000U);
  start();
  const std::vector<RawClient> idle = connectMany(2000, "");
  std::vector<RawClient> drips = connectMany(100, "GET /livez HTTP/1.1\r\nHost: a\r\nA: ");
  for (RawClient& client :
       connectMany(100, "PUT /bytes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 900000\r\n\r\n")) {
    drips.push_back(std::move(client));
  }
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 2200; }));
  for (int round = 0; round < 20; ++round) {
    for (RawClient& drip : drips) {
      drip.send("a");
    }
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(ask(makeGet("/livez")).status, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, milliseconds(500));
  }
}

TEST_F(CrowdTest, ConnectionsBeyondTheLimitAreTurnedAway) {
  ServerOptions options;
  options.max_connections = 10;
  start(options);
  std::vector<RawClient> clients = connectMany(10, "GET /livez HTTP/1.1\r\n");
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 10; }));
  const RawReply reply = ask(makeGet("/livez"));
  EXPECT_EQ(reply.status, 503);
  EXPECT_NE(reply.header("retry-after"), "");
  clients.clear();
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 0; }));
  EXPECT_EQ(ask(makeGet("/livez")).status, 200);
}

// Idle connections make room for those who have something to ask.
TEST_F(CrowdTest, TheLongestIdleConnectionMakesRoom) {
  ServerOptions options;
  options.max_connections = 10;
  start(options);
  std::vector<RawClient> idle = connectMany(10, "");
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 10; }));
  int status = 0;
  for (int i = 0; i < 500 && status != 200; ++i) {
    status = ask(makeGet("/livez")).status;
    std::this_thread::sleep_for(milliseconds(10));
  }
  EXPECT_EQ(status, 200);
  EXPECT_TRUE(idle[0].isClosedWithin(seconds(5)));
}

TEST_F(CrowdTest, OneAddressHasItsShare) {
  ServerOptions options;
  options.max_per_address = 5;
  options.count_loopback = true;
  start(options);
  const std::vector<RawClient> clients = connectMany(5, "");
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 5; }));
  const RawReply reply = ask(makeGet("/livez"));
  EXPECT_EQ(reply.status, 503);
  EXPECT_NE(reply.body.find("this address"), std::string::npos);
}

TEST_F(CrowdTest, RequestsBeyondTheQueueAreTurnedAwayAtOnce) {
  ServerOptions options;
  options.threads = 2;
  options.max_queued = 3;
  start(options);
  std::vector<RawClient> running = connectMany(2, makeGet("/held"));
  state().latch.awaitWaiting(2);
  std::vector<RawClient> queued = connectMany(3, makeGet("/livez"));
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.queued == 3; }));
  RawClient client = connect();
  client.send(makeGet("/livez"));
  const RawReply refused = client.read();
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.header("retry-after"), "");
  EXPECT_NE(refused.body.find("request.busy"), std::string::npos);
  state().latch.open();
  for (RawClient& waited : queued) {
    EXPECT_EQ(waited.read().status, 200);
  }
  client.send(makeGet("/livez"));  // the same connection is welcome again
  EXPECT_EQ(client.read().status, 200);
}

TEST_F(CrowdTest, BodiesBeyondTheirRoomAreTurnedAway) {
  ServerOptions options;
  options.max_body_memory = 1'000;
  options.max_spool_bytes = 1'000'000;
  start(options);
  const std::string begin =
      "PUT /bytes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 900000\r\nExpect: 100-continue\r\n\r\n";
  RawClient first = connect();
  first.send(begin);
  EXPECT_EQ(first.readHead().status, 100);  // it has its room now
  const RawReply refused = ask(begin);
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.header("retry-after"), "");
  first.close();
  // The reactor leaves the closing of spooled bodies to a handler: the room is there a moment
  // later.
  const std::string request = makeRequest("PUT", "/bytes/a", "a/b", makePattern(0, 900'000));
  RawReply accepted = ask(request);
  for (int i = 0; accepted.status == 503 && i < 1000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    accepted = ask(request);
  }
  EXPECT_EQ(accepted.body, "same 900000");
}

TEST_F(CrowdTest, ADiskWithoutRoomIsToldBeforeTheBody) {
  ServerOptions options;
  options.spool_free_bytes = 1ULL << 62U;
  start(options);
  const RawReply reply = ask("PUT /bytes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 900000\r\n\r\n");
  EXPECT_EQ(reply.status, 507);
  EXPECT_NE(reply.body.find("storage.full"), std::string::npos);
  EXPECT_EQ(ask(makeRequest("PUT", "/bytes/a", "a/b", makePattern(0, 9))).status, 200);
}

TEST_F(CrowdTest, DescriptorsAreGivenBack) {
  start();
  const std::string head = "PUT /bytes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 900000\r\n\r\n";
  EXPECT_EQ(ask(makeGet("/livez")).status, 200);
  ASSERT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 0; }));
  const std::size_t before = countDescriptors();
  for (int i = 0; i < 3000; ++i) {
    RawClient client = connect();
    client.send(i % 3 == 0 ? makeGet("/livez") : i % 3 == 1 ? head + "abc" : makeGet("/large"));
    if (i % 3 == 0) {
      EXPECT_EQ(client.read().status, 200);
    }
  }
  EXPECT_TRUE(server().awaitLoad([](const ServerLoad& load) { return load.connections == 0; }));
  // Spool files are closed by the handler threads, soon after.
  for (int i = 0; i < 1000 && countDescriptors() != before; ++i) {
    std::this_thread::sleep_for(milliseconds(10));
  }
  EXPECT_EQ(countDescriptors(), before);
}

}  // namespace
}  // namespace gaitmill::api
