// How the transport answers good requests: over a real socket, with stub routes.

#include <zlib.h>

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "tests/api/transport/transport_server.h"

namespace gaitmill::api {
namespace {

std::string unzip(const std::string& packed) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  std::string input = packed;
  std::string text(1U << 20U, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

class ExchangeTest : public TransportTest {
 protected:
  ExchangeTest() { start(); }
};

TEST_F(ExchangeTest, AnswersCarryIdDateAndLength) {
  const RawReply reply = ask(makeGet("/livez"));
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "ok");
  EXPECT_EQ(reply.header("content-length"), "2");
  EXPECT_EQ(reply.header("content-type"), "text/plain");
  EXPECT_EQ(reply.header("x-content-type-options"), "nosniff");
  EXPECT_EQ(reply.header("cache-control"), "no-store");
  EXPECT_EQ(reply.header("request-id").substr(0, 4), "req_");
  EXPECT_EQ(reply.header("date").substr(reply.header("date").size() - 4), " GMT");
}

TEST_F(ExchangeTest, OneConnectionTakesManyRequestsInOrder) {
  RawClient client = connect();
  std::string requests;
  for (int i = 0; i < 200; ++i) {
    requests += makeGet("/items/i" + std::to_string(i));
  }
  ASSERT_TRUE(client.send(requests));
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(client.read().body, "i" + std::to_string(i) + " ");
  }
}

TEST_F(ExchangeTest, BytesMayComeOneByOne) {
  RawClient client = connect();
  for (const char byte : "\r\n" + makeRequest("POST", "/json", "application/json", "{\"a\": 1}")) {
    ASSERT_TRUE(client.send({&byte, 1}));
  }
  EXPECT_EQ(client.read().body, "{\"a\": 1}");
}

TEST_F(ExchangeTest, ConnectionCloseAndOldVersionsEndTheConnection) {
  for (const std::string& request :
       {makeGet("/livez", "Connection: close\r\n"), std::string("GET /livez HTTP/1.0\r\n\r\n")}) {
    RawClient client = connect();
    client.send(request);
    const RawReply reply = client.read();
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.header("connection"), "close");
    EXPECT_TRUE(client.isClosedWithin(std::chrono::seconds(5)));
  }
  RawClient client = connect();
  client.send("GET /livez HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
  EXPECT_EQ(client.read().header("connection"), "keep-alive");
  client.send(makeGet("/livez"));
  EXPECT_EQ(client.read().status, 200);
}

TEST_F(ExchangeTest, ClientMayEndSendingBeforeItReads) {
  RawClient client = connect();
  client.send(makeGet("/table"));
  client.endSending();
  EXPECT_EQ(client.read().status, 200);
}

TEST_F(ExchangeTest, AbsoluteTargetsAreTaken) {
  EXPECT_EQ(ask("GET http://test/livez HTTP/1.1\r\nHost: test\r\n\r\n").body, "ok");
}

TEST_F(ExchangeTest, PathAndQueryAreDecoded) {
  EXPECT_EQ(ask(makeGet("/items/a%2Db?q=x%20y+z&q=second")).body, "a-b x y z");
}

TEST_F(ExchangeTest, UnknownPathsAndMethodsAreProblems) {
  const RawReply unknown = ask(makeGet("/nowhere"));
  EXPECT_EQ(unknown.status, 404);
  EXPECT_EQ(unknown.header("content-type"), "application/problem+json");
  EXPECT_NE(unknown.body.find("request.not_found"), std::string::npos);
  EXPECT_NE(unknown.body.find(unknown.header("request-id")), std::string::npos);
  const RawReply method = ask(makeRequest("PATCH", "/items/a", "text/plain", ""));
  EXPECT_EQ(method.status, 405);
  EXPECT_EQ(method.header("allow"), "GET, DELETE, HEAD, OPTIONS");
}

TEST_F(ExchangeTest, OptionsSaysWhatThePathTakes) {
  const RawReply reply = ask("OPTIONS /items/a HTTP/1.1\r\nHost: test\r\n\r\n");
  EXPECT_EQ(reply.status, 204);
  EXPECT_EQ(reply.header("allow"), "GET, DELETE, HEAD, OPTIONS");
  EXPECT_EQ(reply.headers.count("content-length"), 0U);
  EXPECT_EQ(ask("OPTIONS * HTTP/1.1\r\nHost: test\r\n\r\n").status, 204);
  EXPECT_EQ(ask("OPTIONS /nowhere HTTP/1.1\r\nHost: test\r\n\r\n").status, 404);
}

TEST_F(ExchangeTest, DeleteAnswersWithoutContent) {
  const RawReply reply = ask("DELETE /items/a HTTP/1.1\r\nHost: test\r\n\r\n");
  EXPECT_EQ(reply.status, 204);
  EXPECT_EQ(reply.headers.count("content-length"), 0U);
  EXPECT_EQ(reply.headers.count("content-type"), 0U);
}

TEST_F(ExchangeTest, RequestIdsOfClientsAreKeptIfHarmless) {
  EXPECT_EQ(ask(makeGet("/echo", "X-Request-Id: abc-1.2_3\r\n")).body, "abc-1.2_3");
  EXPECT_EQ(ask(makeGet("/echo", "X-Request-Id: a b\r\n")).body.substr(0, 4), "req_");
  EXPECT_EQ(
      ask(makeGet("/echo", "X-Request-Id: " + std::string(65, 'a') + "\r\n")).body.substr(0, 4),
      "req_");
}

// What a route puts into a header cannot begin another one.
TEST_F(ExchangeTest, HeaderValuesCannotSplitTheReply) {
  const RawReply reply = ask(makeGet("/echo?v=a%0D%0ASet-Cookie:%20b"));
  EXPECT_EQ(reply.header("x-echo"), "a  Set-Cookie: b");
  EXPECT_EQ(reply.headers.count("set-cookie"), 0U);
}

TEST_F(ExchangeTest, FaultsOfOurOwnAreLoggedAndNotShown) {
  const RawReply reply = ask(makeGet("/fails"));
  EXPECT_EQ(reply.status, 500);
  EXPECT_EQ(reply.body.find("as the test wants"), std::string::npos);
  server().stop();
  ASSERT_EQ(state().errors.size(), 1U);
  EXPECT_NE(state().errors[0].find("as the test wants"), std::string::npos);
  EXPECT_NE(state().errors[0].find(reply.header("request-id")), std::string::npos);
}

// --- bodies ---

TEST_F(ExchangeTest, JsonBodiesArriveWhole) {
  const std::string body = "[" + std::string(900'000, ' ') + "1]";  // beyond what memory may hold
  EXPECT_EQ(ask(makeRequest("POST", "/json", "application/json; charset=utf-8", body)).body, body);
}

TEST_F(ExchangeTest, RawBodiesArriveWholeAndUnchanged) {
  for (const std::size_t size : {0UL, 1UL, 262'144UL, 262'145UL, 5'000'000UL}) {
    const RawReply reply =
        ask(makeRequest("PUT", "/bytes/a", "application/x-anything", makePattern(0, size)));
    EXPECT_EQ(reply.body, "same " + std::to_string(size));
  }
}

std::string makeParts(const std::vector<std::string>& contents) {
  std::string body;
  for (const std::string& content : contents) {
    body += "--b b\r\nContent-Disposition: form-data; name=\"p\"; filename=\"f.trc\"\r\n\r\n" +
            content + "\r\n";
  }
  return body + "--b b--\r\n";
}

TEST_F(ExchangeTest, MultipartBodiesArriveInParts) {
  const std::string type = "multipart/form-data; boundary=\"b b\"";
  EXPECT_EQ(ask(makeRequest("POST", "/parts", type, makeParts({"one", "", "--b"}))).body,
            "p=f.trc:3:one;p=f.trc:0:;p=f.trc:3:--b;");
  EXPECT_EQ(ask(makeRequest("POST", "/either", type, makeParts({"one"}))).body, "p=f.trc:3:one;");
  EXPECT_EQ(ask(makeRequest("POST", "/either", "application/json", "{}")).status, 200);
  const std::string large(3'000'000, 'x');
  EXPECT_EQ(ask(makeRequest("POST", "/parts", type, makeParts({"a"}) + large)).body,
            "p=f.trc:1:a;");
}

TEST_F(ExchangeTest, ContinueIsSentOnceTheHeadIsAccepted) {
  RawClient client = connect();
  const std::string request =
      makeRequest("PUT", "/bytes/a", "text/plain", makePattern(0, 9), "Expect: 100-continue\r\n");
  client.send(request.substr(0, request.size() - 9));
  EXPECT_EQ(client.readHead().status, 100);
  client.send(request.substr(request.size() - 9));
  EXPECT_EQ(client.read().body, "same 9");
  client.send(
      "PUT /nowhere HTTP/1.1\r\nHost: test\r\nContent-Length: 9\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(client.read().status, 404);
}

// --- forms of replies ---

TEST_F(ExchangeTest, HeadAnswersWithTheLengthAndNoBody) {
  RawClient client = connect();
  client.send("HEAD /large HTTP/1.1\r\nHost: test\r\n\r\n" + makeGet("/livez"));
  const RawReply head = client.readHead();
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.header("content-length"), std::to_string(kLargeBytes));
  EXPECT_EQ(head.header("accept-ranges"), "bytes");
  EXPECT_EQ(client.read().body, "ok");
}

TEST_F(ExchangeTest, LargeRepliesArriveWhole) {
  const RawReply reply = ask(makeGet("/large"));
  EXPECT_EQ(reply.status, 200);
  EXPECT_TRUE(reply.body == makePattern(0, kLargeBytes));
}

TEST_F(ExchangeTest, OneRangeIsAnsweredFromItsPlace) {
  struct Case {
    const char* range;
    std::uint64_t first, last;
  };
  for (const Case& wanted : {Case{"bytes=0-0", 0, 0},
                             Case{"bytes=100-299", 100, 299},
                             Case{"bytes=7999990-", 7999990, kLargeBytes - 1},
                             Case{"bytes=7999990-9999999", 7999990, kLargeBytes - 1},
                             Case{"bytes=-5", kLargeBytes - 5, kLargeBytes - 1},
                             Case{"bytes=1000-1000999", 1000, 1000999}}) {
    const RawReply reply = ask(makeGet("/large", std::string("Range: ") + wanted.range + "\r\n"));
    EXPECT_EQ(reply.status, 206) << wanted.range;
    EXPECT_EQ(reply.header("content-range"),
              "bytes " + std::to_string(wanted.first) + "-" + std::to_string(wanted.last) + "/" +
                  std::to_string(kLargeBytes));
    EXPECT_TRUE(reply.body == makePattern(wanted.first, wanted.last - wanted.first + 1))
        << wanted.range;
  }
}

TEST_F(ExchangeTest, RangesBeyondTheEndAre416) {
  for (const char* range : {"bytes=8000000-", "bytes=9000000-9000001", "bytes=-0"}) {
    const RawReply reply = ask(makeGet("/large", std::string("Range: ") + range + "\r\n"));
    EXPECT_EQ(reply.status, 416) << range;
    EXPECT_EQ(reply.header("content-range"), "bytes */8000000");
    EXPECT_NE(reply.body.find("request.range"), std::string::npos);
  }
}

TEST_F(ExchangeTest, WhatIsNotOneRangeGetsTheWhole) {
  for (const char* range :
       {"bytes=0-1,3-4", "bytes=5-3", "bytes=a-b", "lines=0-1", "bytes=-", "bytes 0-1"}) {
    RawClient client = connect();
    client.send(makeGet("/large", std::string("Range: ") + range + "\r\n"));
    EXPECT_EQ(client.readHead().status, 200) << range;
  }
}

TEST_F(ExchangeTest, IfRangeOfAnotherVersionGetsTheWhole) {
  const auto statusOf = [this](const std::string& tag) {
    RawClient client = connect();
    client.send(makeGet("/large", "Range: bytes=0-1\r\nIf-Range: " + tag + "\r\n"));
    return client.readHead().status;
  };
  EXPECT_EQ(statusOf("\"large\""), 206);
  EXPECT_EQ(statusOf("\"other\""), 200);
  EXPECT_EQ(statusOf("W/\"large\""), 200);
}

TEST_F(ExchangeTest, KnownTagsAreNotModified) {
  for (const char* tags : {"\"table\"", "W/\"table\"", "\"a\", \"table\"", "*", "\"table-gzip\""}) {
    const RawReply reply = ask(makeGet("/table", std::string("If-None-Match: ") + tags + "\r\n"));
    EXPECT_EQ(reply.status, 304) << tags;
    EXPECT_EQ(reply.header("etag").substr(0, 6), "\"table");
    EXPECT_EQ(reply.headers.count("content-length"), 0U);
    EXPECT_EQ(reply.header("vary"), "Accept-Encoding");
  }
  EXPECT_EQ(ask(makeGet("/table", "If-None-Match: \"other\"\r\n")).status, 200);
}

TEST_F(ExchangeTest, TextIsCompressedForThoseWhoTakeIt) {
  const RawReply plain = ask(makeGet("/table"));
  EXPECT_EQ(plain.header("etag"), "\"table\"");
  EXPECT_EQ(plain.header("vary"), "Accept-Encoding");
  for (const char* accepts : {"gzip", "deflate, gzip;q=0.5", "*"}) {
    const RawReply packed =
        ask(makeGet("/table", std::string("Accept-Encoding: ") + accepts + "\r\n"));
    EXPECT_EQ(packed.header("content-encoding"), "gzip") << accepts;
    EXPECT_EQ(packed.header("etag"), "\"table-gzip\"");
    EXPECT_LT(packed.body.size(), 1000U);
    EXPECT_TRUE(unzip(packed.body) == plain.body);
  }
  for (const char* refuses : {"gzip;q=0", "gzip;q=0.000, *", "br", "identity"}) {
    EXPECT_EQ(ask(makeGet("/table", std::string("Accept-Encoding: ") + refuses + "\r\n"))
                  .headers.count("content-encoding"),
              0U)
        << refuses;
  }
}

TEST_F(ExchangeTest, ShortAndBinaryRepliesAreNotCompressed) {
  EXPECT_EQ(ask(makeGet("/livez", "Accept-Encoding: gzip\r\n")).body, "ok");
  EXPECT_EQ(ask(makeGet("/large", "Accept-Encoding: gzip\r\n")).headers.count("content-encoding"),
            0U);
}

// --- keys ---

class KeyTest : public TransportTest {
 protected:
  KeyTest() {
    ServerOptions options;
    options.authenticate = [](const std::string& header) -> std::optional<Identity> {
      if (header == "Bearer reader") {
        return Identity{"lab_a", "key_1", true, false, false};
      }
      if (header == "Bearer admin") {
        return Identity{"lab_b", "key_2", true, true, true};
      }
      return std::nullopt;
    };
    start(std::move(options));
  }
};

TEST_F(KeyTest, RoutesAskForTheirScope) {
  EXPECT_EQ(ask(makeGet("/livez")).status, 200);
  const RawReply nobody = ask(makeGet("/secret"));
  EXPECT_EQ(nobody.status, 401);
  EXPECT_EQ(nobody.header("www-authenticate").substr(0, 6), "Bearer");
  EXPECT_EQ(ask(makeGet("/secret", "Authorization: Bearer wrong\r\n")).status, 401);
  EXPECT_EQ(ask(makeGet("/secret", "Authorization: Bearer reader\r\n")).body, "lab_a");
  EXPECT_EQ(ask(makeGet("/secret", "Authorization: Bearer admin\r\n")).body, "lab_b");
}

// Without a key not one byte of the body is waited for.
TEST_F(KeyTest, KeysAreAskedBeforeTheBodyIsRead) {
  const std::string head = "POST /secret HTTP/1.1\r\nHost: test\r\nContent-Length: 1000000\r\n";
  EXPECT_EQ(ask(head + "\r\n").status, 401);
  EXPECT_EQ(ask(head + "Authorization: Bearer reader\r\n\r\n").status, 403);
  EXPECT_EQ(
      ask("DELETE /secret HTTP/1.1\r\nHost: test\r\nAuthorization: Bearer reader\r\n\r\n").status,
      403);
  EXPECT_EQ(state().calls, 0);
}

// --- records ---

TEST_F(ExchangeTest, EachRequestIsRecordedOnce) {
  RawClient client = connect();
  client.send(makeGet("/items/a", "X-Request-Id: first\r\n") +
              makeRequest("POST", "/json", "application/json", "{}") + makeGet("/nowhere"));
  const std::size_t replies = client.read().body.size() + client.read().body.size();
  client.read();
  server().stop();
  ASSERT_EQ(state().records.size(), 3U);
  const RequestRecord& first = state().records[0];
  EXPECT_EQ(first.id, "first");
  EXPECT_EQ(first.method, "GET");
  EXPECT_EQ(first.pattern, "/items/{id}");
  EXPECT_EQ(first.path, "/items/a");
  EXPECT_EQ(first.client, "127.0.0.1");
  EXPECT_EQ(first.tenant, "local");
  EXPECT_EQ(first.status, 200);
  EXPECT_GE(first.seconds, 0.0);
  EXPECT_EQ(state().records[1].request_bytes, 2U);
  EXPECT_GT(first.reply_bytes + state().records[1].reply_bytes, replies);
  EXPECT_EQ(state().records[2].status, 404);
  EXPECT_EQ(state().records[2].pattern, "");
}

}  // namespace
}  // namespace gaitmill::api
