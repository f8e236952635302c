// The routes behind a real socket: the contract of openapi.yaml, and hostile clients.

#include "api/server.h"

#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "api/routes.h"
#include "core/base/error.h"
#include "tests/api/stub_ports.h"
#include "tests/http/api_contract.h"
#include "tests/http/http_client.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

const ClientPart kSubject{"trial", "", R"({"mass_kg": 75.3, "height_m": 1.7})"};

class ServerTest : public ::testing::Test {
 protected:
  ServerTest() : server_(makeRoutes(stub_.ports(), "1.2.3"), makeOptions(), ignoreLog) {
    client_ = HttpClient(server_.bind());
    thread_ = std::thread([this] { server_.run(); });
  }
  ~ServerTest() override {
    server_.stop();
    thread_.join();
  }

  static ServerOptions makeOptions() {
    ServerOptions options;
    options.threads = 4;
    options.max_json_bytes = 2048;
    options.max_upload_bytes = 4096;
    options.max_header_bytes = 4096;
    options.max_headers = 20;
    options.max_parts = 4;
    options.header_deadline = std::chrono::seconds(1);
    options.body_deadline = std::chrono::seconds(1);
    return options;
  }
  static void ignoreLog(LogLevel, const std::string&) {}

  // Status of the first answer to these bytes, 0 if there is none.
  int statusOf(const std::string& bytes) const {
    const std::string answer = client_.sendRaw(bytes, "\r\n");
    return answer.size() > 12 ? std::stoi(answer.substr(9, 3)) : 0;
  }

  StubPorts stub_;
  Server server_;
  HttpClient client_{0};
  std::thread thread_;
};

// --- the contract ---

struct ContractCase {
  std::string method;
  std::string pattern;
  int status;
  std::string path;
  ErrorCode failure = ErrorCode::kUsage;  // kUsage = the ports answer
};

std::vector<ContractCase> listGets() {
  const std::string job = std::string("/v1/jobs/") + kJobId;
  const std::string trial = std::string("/v1/trials/") + kTrialId;
  const std::string result = "/v1/jobs/{id}/results/{name}";
  const std::string file = "/v1/jobs/{id}/files/{name}";
  return {
      {"GET", "/healthz", 200, "/healthz"},
      {"GET", "/v1/version", 200, "/v1/version"},
      {"GET", "/v1/trials/{id}", 200, trial},
      {"GET", "/v1/trials/{id}", 404, trial, ErrorCode::kTrialNotFound},
      {"GET", "/v1/trials/{id}", 500, trial, ErrorCode::kStorage},
      {"GET", "/v1/jobs/{id}", 200, job},
      {"GET", "/v1/jobs/{id}", 404, job, ErrorCode::kJobNotFound},
      {"GET", "/v1/jobs/{id}", 500, job, ErrorCode::kInternal},
      {"GET", result, 200, job + "/results/moments"},
      {"GET", result, 200, job + "/results/moments?format=csv&axis=cycle"},
      {"GET", result, 200, job + "/results/moments?format=sto&angles=deg"},
      {"GET", result, 200, job + "/results/quality"},
      {"GET", result, 404, job + "/results/nothing"},
      {"GET", result, 406, job + "/results/moments?format=xml"},
      {"GET", result, 409, job + "/results/moments", ErrorCode::kResultNotReady},
      {"GET", result, 422, job + "/results/moments?axis=width"},
      {"GET", result, 500, job + "/results/moments", ErrorCode::kStorage},
      {"GET", "/v1/jobs/{id}/files", 200, job + "/files"},
      {"GET", "/v1/jobs/{id}/files", 404, job + "/files", ErrorCode::kJobNotFound},
      {"GET", "/v1/jobs/{id}/files", 409, job + "/files", ErrorCode::kResultNotReady},
      {"GET", "/v1/jobs/{id}/files", 500, job + "/files", ErrorCode::kStorage},
      {"GET", file, 200, job + "/files/ik.mot"},
      {"GET", file, 404, job + "/files/ik.mot", ErrorCode::kResultNotFound},
      {"GET", file, 409, job + "/files/ik.mot", ErrorCode::kResultNotReady},
      {"GET", file, 500, job + "/files/ik.mot", ErrorCode::kStorage},
  };
}

class ContractTest : public ServerTest {
 protected:
  void expectContract(const ContractCase& wanted, const ClientReply& reply) {
    SCOPED_TRACE(wanted.method + " " + wanted.pattern + " " + std::to_string(wanted.status));
    EXPECT_EQ(reply.status, wanted.status) << reply.body;
    for (const auto& fault : contract_.findFaults(wanted.method, wanted.pattern, reply)) {
      ADD_FAILURE() << fault;
    }
    produced_.emplace(wanted.method, wanted.pattern, reply.status);
  }
  void setFailure(ErrorCode code) {
    stub_.record.failure = std::nullopt;
    if (code != ErrorCode::kUsage) {
      stub_.record.failure = Error(code, "as the test wants it", {"walk.trc", 3, 4, "RASI"});
    }
  }
  // A request whose headers alone are sent.
  ClientReply post(const std::string& path, const std::string& headers) {
    const std::string answer =
        client_.sendRaw("POST " + path + " HTTP/1.1\r\nConnection: close\r\n" + headers + "\r\n");
    ClientReply reply;
    reply.status = answer.size() > 12 ? std::stoi(answer.substr(9, 3)) : 0;
    reply.headers["Content-Type"] = "application/json";
    reply.body = answer.substr(std::min(answer.find("\r\n\r\n") + 4, answer.size()));
    return reply;
  }

  void checkGets() {
    for (const ContractCase& wanted : listGets()) {
      setFailure(wanted.failure);
      expectContract(wanted, client_.get(wanted.path));
    }
    setFailure(ErrorCode::kUsage);
    for (const char* path : {"/healthz", "/v1/version"}) {
      expectContract({"GET", path, 400, path}, client_.get(path, {{"Content-Length", "x"}}));
    }
  }

  void checkTrials() {
    const std::string path = "/v1/trials";
    const std::vector<ClientPart> good = {kSubject, {"markers", "walk.trc", "bytes"}};
    const auto upload = [&](int status, const std::vector<ClientPart>& parts, ErrorCode failure) {
      setFailure(failure);
      expectContract({"POST", path, status, path}, client_.upload(path, parts));
    };
    upload(201, good, ErrorCode::kUsage);
    upload(400, {{"trial", "", "{"}}, ErrorCode::kUsage);
    upload(413, {kSubject, {"markers", "big", std::string(5000, 'x')}}, ErrorCode::kUsage);
    upload(422, good, ErrorCode::kTrcColumnCount);
    upload(500, good, ErrorCode::kStorage);
    expectContract({"POST", path, 411, path}, post(path, "Content-Type: multipart/form-data\r\n"));
    expectContract({"POST", path, 415, path}, client_.post(path, "{}"));
  }

  void checkJobs() {
    const std::string path = "/v1/jobs";
    const auto submit = [&](int status, const std::string& body, ErrorCode failure) {
      setFailure(failure);
      expectContract({"POST", path, status, path}, client_.post(path, body));
    };
    submit(202, R"({"trial": "tri_1"})", ErrorCode::kUsage);
    submit(400, "not json", ErrorCode::kUsage);
    submit(404, R"({"trial": "tri_1"})", ErrorCode::kTrialNotFound);
    submit(413, std::string(3000, ' '), ErrorCode::kUsage);
    submit(422, R"({"trail": "tri_1"})", ErrorCode::kUsage);
    submit(500, R"({"trial": "tri_1"})", ErrorCode::kInternal);
    expectContract({"POST", path, 411, path}, post(path, "Content-Type: application/json\r\n"));
    expectContract({"POST", path, 415, path}, client_.post(path, "{}", "text/plain"));
  }

  void checkCancel() {
    const std::string pattern = "/v1/jobs/{id}/cancel";
    const std::string path = std::string("/v1/jobs/") + kJobId + "/cancel";
    const auto cancel = [&](int status, ErrorCode failure) {
      setFailure(failure);
      expectContract({"POST", pattern, status, path}, client_.post(path, "", "text/plain"));
    };
    cancel(202, ErrorCode::kUsage);
    cancel(404, ErrorCode::kJobNotFound);
    cancel(409, ErrorCode::kJobState);
    cancel(500, ErrorCode::kStorage);
  }

  ApiContract contract_;
  std::set<ApiContract::Answer> produced_;
};

TEST_F(ContractTest, EveryDocumentedAnswerIsGivenAndFitsItsSchema) {
  checkGets();
  checkTrials();
  checkJobs();
  checkCancel();
  for (const auto& [method, path, status] : contract_.listAnswers()) {
    EXPECT_EQ(produced_.count({method, path, status}), 1U)
        << method << " " << path << " " << status << " is documented and was never seen";
  }
}

TEST_F(ContractTest, RouterAndDocumentHaveTheSameRoutes) {
  std::set<std::string> documented;
  for (const auto& [method, path, status] : contract_.listAnswers()) {
    documented.insert(method + " " + path);
  }
  std::set<std::string> routed;
  for (const Route& route : makeRoutes(stub_.ports(), "1")) {
    routed.insert(route.method + " " + route.pattern);
  }
  EXPECT_EQ(documented, routed);
}

// --- manners ---

TEST_F(ServerTest, WrongMethodIsToldTheRightOnes) {
  const ClientReply reply = client_.post("/healthz", "{}");
  EXPECT_EQ(reply.status, 405);
  EXPECT_EQ(reply.headers.at("Allow"), "GET");
  EXPECT_EQ(reply.json()["error"]["code"], "request.method_not_allowed");
  EXPECT_EQ(statusOf("BREW /healthz HTTP/1.1\r\n\r\n"), 400);
}

TEST_F(ServerTest, UnknownPathIsNotFoundInJson) {
  const ClientReply reply = client_.get("/v2/jobs");
  EXPECT_EQ(reply.status, 404);
  EXPECT_EQ(reply.json()["error"]["code"], "request.not_found");
}

TEST_F(ServerTest, HeadAnswersWithoutBody) {
  const std::string answer =
      client_.sendRaw("HEAD /v1/version HTTP/1.1\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(answer.substr(0, 15), "HTTP/1.1 200 OK");
  EXPECT_EQ(answer.substr(answer.find("\r\n\r\n")), "\r\n\r\n");
}

TEST_F(ServerTest, OneConnectionTakesManyRequests) {
  std::string requests;
  for (int i = 0; i < 20; ++i) {
    requests += "GET /healthz HTTP/1.1\r\n\r\n";
  }
  const std::string answer =
      client_.sendRaw(requests + "GET /healthz HTTP/1.1\r\nConnection: close\r\n\r\n");
  std::size_t count = 0;
  for (std::size_t at = 0; (at = answer.find("HTTP/1.1 200", at)) != std::string::npos; ++at) {
    ++count;
  }
  EXPECT_EQ(count, 21U);
}

TEST_F(ServerTest, ExpectContinueIsRefusedBeforeTheBodyIsSent) {
  EXPECT_EQ(statusOf("POST /v1/trials HTTP/1.1\r\nContent-Type: multipart/form-data; boundary=x\r\n"
                     "Content-Length: 5000\r\nExpect: 100-continue\r\n\r\n"),
            413);
  EXPECT_EQ(statusOf("POST /v1/jobs HTTP/1.1\r\nContent-Type: application/json\r\n"
                     "Content-Length: 18\r\nExpect: 100-continue\r\n\r\n"),
            100);
}

// --- hostile requests: refused with a status, never served, and the service lives ---

struct Attack {
  const char* name;
  std::string bytes;
  int status;
};

std::string makePost(const std::string& headers, const std::string& body = "") {
  return "POST /v1/jobs HTTP/1.1\r\nContent-Type: application/json\r\n" + headers + "\r\n" + body;
}

std::string makeUpload(const std::string& body) {
  return "POST /v1/trials HTTP/1.1\r\nContent-Type: multipart/form-data; boundary=x\r\n"
         "Content-Length: " +
         std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string repeat(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) {
    all += text;
  }
  return all;
}

std::vector<Attack> listAttacks() {
  const std::string part = "--x\r\nContent-Disposition: form-data; name=\"grf\"\r\n\r\nb\r\n";
  return {
      {"nothing but noise", std::string(300, '\x01') + "\r\n\r\n", 400},
      {"long path", "GET /" + std::string(2000, 'a') + " HTTP/1.1\r\n\r\n", 414},
      {"endless header line", "GET /healthz HTTP/1.1\r\nA: " + std::string(9000, 'a'), 400},
      {"many headers", "GET /healthz HTTP/1.1\r\n" + repeat("A: b\r\n", 50) + "\r\n", 400},
      {"chunked body", makePost("Transfer-Encoding: chunked\r\n", "5\r\nhello\r\n0\r\n\r\n"), 411},
      {"negative length", makePost("Content-Length: -1\r\n", "{}"), 400},
      {"two lengths", makePost("Content-Length: 2\r\nContent-Length: 40\r\n", "{}"), 400},
      {"length with sign", makePost("Content-Length: +2\r\n", "{}"), 400},
      {"huge length", makePost("Content-Length: 99999999999999999999\r\n"), 400},
      {"large length", makePost("Content-Length: 1000000\r\n"), 413},
      {"encoded body", makePost("Content-Length: 2\r\nContent-Encoding: gzip\r\n", "{}"), 415},
      {"deep JSON", makePost("Content-Length: 2000\r\n", std::string(2000, '[')), 400},
      {"empty multipart", makeUpload("--x--\r\n"), 400},
      {"broken multipart", makeUpload("--y\r\nnothing\r\n"), 400},
      {"cut multipart", makeUpload("--x\r\nContent-Disposition: form-data; na"), 400},
      {"many parts", makeUpload(repeat(part, 30) + "--x--\r\n"), 400},
      {"traversal",
       "GET /v1/jobs/" + std::string(kJobId) + "/files/../../../etc/passwd HTTP/1.1\r\n\r\n",
       404},
      {"encoded traversal",
       "GET /v1/jobs/" + std::string(kJobId) + "/files/..%2f..%2fetc%2fpasswd HTTP/1.1\r\n\r\n",
       404},
      {"null byte", "GET /v1/jobs/%00 HTTP/1.1\r\n\r\n", 404},
      {"slow headers", "GET /healthz HTTP/1.1\r\nA:", 400},
      {"slow body", makePost("Content-Length: 100\r\n", "{"), 400},
  };
}

TEST_F(ServerTest, HostileRequestsAreRefusedAndTheServiceLives) {
  for (const Attack& attack : listAttacks()) {
    EXPECT_EQ(statusOf(attack.bytes), attack.status) << attack.name;
    EXPECT_EQ(client_.get("/healthz").status, 200) << "after: " << attack.name;
  }
  EXPECT_TRUE(stub_.record.calls.empty()) << stub_.record.calls.front();
}

// Hundreds of ranges of one reply would multiply it; they are not taken.
TEST_F(ServerTest, RangesAreIgnored) {
  const std::string ranges = repeat("0-,", 500) + "0-";
  const ClientReply reply = client_.get("/v1/version", {{"Range", "bytes=" + ranges}});
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, R"({"name":"gaitmill","version":"1.2.3"})");
}

// An unread body must not be taken for the next request.
TEST_F(ServerTest, RefusedBodyIsNotServedAsARequest) {
  const std::string hidden = "GET /v1/version HTTP/1.1\r\n\r\n";
  const std::string length = "Content-Length: " + std::to_string(hidden.size()) + "\r\n";
  for (const std::string& request :
       {"POST /nowhere HTTP/1.1\r\n" + length + "\r\n" + hidden,
        "GET /healthz HTTP/1.1\r\n" + length + "\r\n" + hidden,
        "POST /v1/jobs HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n" + hidden}) {
    EXPECT_EQ(client_.sendRaw(request).find("1.2.3"), std::string::npos) << request;
  }
}

TEST_F(ServerTest, PortInUseIsAnError) {
  ServerOptions options = makeOptions();
  Server first(makeRoutes(stub_.ports(), "1"), options, ignoreLog);
  options.port = first.bind();
  Server second(makeRoutes(stub_.ports(), "1"), options, ignoreLog);
  try {
    second.bind();
    FAIL() << "two servers share a port";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kServicePort);
  }
}

}  // namespace
}  // namespace gaitmill::api
