// No route gives a tenant anything of another, and none works without the right key. The routes are
// taken from the router itself, so that a new one cannot be forgotten here.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "api/errors.h"
#include "api/routes.h"
#include "api/server.h"
#include "service/job_input.h"
#include "tests/http/http_client.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

using nlohmann::json;

// What one tenant has: one id of every kind.
struct Belongings {
  std::map<std::string, std::string> ids;  // by the collection's name in paths
  std::string finished_job;
  std::string second_job;  // also finished
  std::string queued_job;
};

// Collections whose entries are the same for everyone.
bool isShared(const api::Route& route) {
  return route.pattern.rfind("/v1/settings", 0) == 0 || route.scope == api::Scope::kNone;
}

// What a route shows is named by its query instead of its path.
bool isComparison(const api::Route& route) {
  return route.pattern.rfind("/v1/compare", 0) == 0;
}

// "trials" of "/v1/trials/{id}/files/{part}"
std::string findCollection(const std::string& pattern) {
  const std::string rest = pattern.substr(std::string("/v1/").size());
  return rest.substr(0, rest.find('/'));
}

class IsolationTest : public ::testing::Test {
 protected:
  IsolationTest() : ports_(fixture_.ports()), routes_(api::makeRoutes(ports_, "test")) {}

  Belongings addBelongings(const api::Identity& who) {
    Belongings all;
    all.finished_job = fixture_.addFinishedJob(who);
    all.second_job = fixture_.addFinishedJob(who);
    all.ids["jobs"] = all.finished_job;
    all.ids["trials"] = ports_.jobs.find(who, all.finished_job).trial_id;
    all.queued_job = fixture_.addJob(who, all.ids["trials"]);
    all.ids["models"] = ports_.models.add(who, "m", R"({"markers": []})").id;
    all.ids["marker_sets"] = ports_.marker_sets.add(who, "s", R"({"markers": ["RASI"]})").id;
    all.ids["keys"] = ports_.keys.add(who, "k", {"read"}).id;
    api::StudyRequest study;
    study.name = "shoes";
    study.jobs.resize(1);
    study.jobs[0].trial_id = all.ids["trials"];
    study.jobs[0].settings_json = "{}";
    all.ids["studies"] = ports_.studies.submit(who, study).id;
    return all;
  }

  api::HttpRequest makeRequest(const api::Route& route, const api::Identity& who) const {
    api::HttpRequest request;
    request.id = "req_test";
    request.method = route.method;
    request.path = route.pattern;
    request.identity = who;
    request.body = api::makeByteSource(route.body == api::BodyKind::kBytes ? "x" : "");
    return request;
  }

  // The same for what belongs to somebody.
  api::HttpRequest makeRequest(const api::Route& route,
                               const api::Identity& who,
                               const Belongings& owner) const {
    api::HttpRequest request = makeRequest(route, who);
    request.captures = fillCaptures(route, owner);
    if (isComparison(route)) {
      request.query["jobs"] = owner.finished_job + "," + owner.second_job;
    }
    return request;
  }

  // The captures of a route filled with what belongs to somebody.
  std::map<std::string, std::string> fillCaptures(const api::Route& route,
                                                  const Belongings& owner) const {
    std::map<std::string, std::string> captures;
    if (route.pattern.find("{id}") != std::string::npos) {
      const std::string collection = findCollection(route.pattern);
      EXPECT_EQ(owner.ids.count(collection), 1U)
          << "say here which id " << route.pattern << " takes";
      captures["id"] = owner.ids.count(collection) == 1 ? owner.ids.at(collection) : "";
    }
    if (route.pattern.find("{part}") != std::string::npos) {
      captures["part"] = "markers";
    }
    if (route.pattern.find("{name}") != std::string::npos) {
      const bool is_file = route.pattern.find("/files/") != std::string::npos;
      const bool is_validation = route.pattern.find("/validation/") != std::string::npos;
      captures["name"] = is_file ? "scaled_model.osim" : is_validation ? "curves" : "moments";
    }
    return captures;
  }

  int findStatus(const api::Route& route, api::HttpRequest request) const {
    try {
      return route.handle(request).status;
    } catch (const Error& error) {
      return api::httpStatus(error.code());
    }
  }

  // All that the tenant's own read routes say, by method, path and captures.
  std::map<std::string, std::string> readEverything(const api::Identity& who,
                                                    const Belongings& own) {
    std::map<std::string, std::string> answers;
    for (const api::Route& route : routes_) {
      if (route.method != "GET" || isShared(route) ||
          route.pattern.find("events") != std::string::npos) {
        continue;
      }
      api::HttpRequest request = makeRequest(route, who, own);
      const api::HttpReply reply = route.handle(request);
      EXPECT_EQ(reply.status, 200) << route.pattern;
      answers[route.pattern] = reply.source ? readSource(*reply.source) : reply.body;
    }
    return answers;
  }

  // What one tenant is told when it sends this document.
  std::string findCode(const std::string& path, const api::Identity& who, const json& document) {
    for (const api::Route& route : routes_) {
      if (route.method == "POST" && route.pattern == path) {
        api::HttpRequest request = makeRequest(route, who);
        request.headers["content-type"] = "application/json";
        request.body = api::makeByteSource(document.dump());
        try {
          return "status " + std::to_string(route.handle(request).status);
        } catch (const Error& error) {
          return std::string(codeName(error.code()));
        }
      }
    }
    return "no route";
  }

  PortFixture fixture_;
  api::Ports ports_;
  api::Routes routes_;
  const api::Identity alice_ = makeMember("alice's lab", "key_a");
  const api::Identity bob_ = makeMember("bob's lab", "key_b");
};

TEST_F(IsolationTest, EveryRouteAnswersNotFoundForIdsOfAnotherTenant) {
  const Belongings of_alice = addBelongings(alice_);
  fixture_.addTrial(bob_);
  const auto before = readEverything(alice_, of_alice);
  int asked = 0;
  for (const api::Route& route : routes_) {
    const bool names_something = route.pattern.find("{id}") != std::string::npos;
    if ((!names_something && !isComparison(route)) || isShared(route)) {
      continue;
    }
    const api::HttpRequest request = makeRequest(route, bob_, of_alice);
    EXPECT_EQ(findStatus(route, request), 404) << route.method << ' ' << route.pattern;
    ++asked;
  }
  EXPECT_GT(asked, 30);
  EXPECT_EQ(readEverything(alice_, of_alice), before) << "nothing of Alice's has changed";
  EXPECT_EQ(ports_.jobs.find(alice_, of_alice.queued_job).state, api::JobState::kQueued);
}

TEST_F(IsolationTest, NoListShowsAnythingOfAnotherTenant) {
  const Belongings of_alice = addBelongings(alice_);
  for (const api::Route& route : routes_) {
    if (route.method != "GET" || route.pattern.find('{') != std::string::npos || isShared(route) ||
        isComparison(route)) {
      continue;
    }
    api::HttpRequest request = makeRequest(route, bob_);
    const std::string body = route.handle(request).body;
    for (const auto& [collection, id] : of_alice.ids) {
      EXPECT_EQ(body.find(id), std::string::npos) << route.pattern << " shows " << id;
    }
  }
}

TEST_F(IsolationTest, FiltersAndCursorsOfAnotherTenantShowNothing) {
  const Belongings of_alice = addBelongings(alice_);
  api::ListFilter filter;
  filter.trial_id = of_alice.ids.at("trials");
  EXPECT_TRUE(ports_.jobs.list(bob_, filter, {}).items.empty());
  filter = {};
  filter.study_id = of_alice.ids.at("studies");
  EXPECT_TRUE(ports_.jobs.list(bob_, filter, {}).items.empty());
  EXPECT_TRUE(ports_.jobs.list(bob_, {}, {of_alice.queued_job, 50}).items.empty());
}

TEST_F(IsolationTest, NothingCanBeBuiltOnWhatBelongsToAnotherTenant) {
  const Belongings of_alice = addBelongings(alice_);
  const std::string own_trial = fixture_.addTrial(bob_);
  const auto& ids = of_alice.ids;
  EXPECT_EQ(findCode("/v1/jobs", bob_, {{"trial", ids.at("trials")}}), "trial.not_found");
  EXPECT_EQ(
      findCode("/v1/studies", bob_, {{"name", "x"}, {"trials", {own_trial, ids.at("trials")}}}),
      "trial.not_found");
  EXPECT_EQ(findCode("/v1/jobs", bob_, {{"trial", own_trial}, {"model", ids.at("models")}}),
            "model.not_found");
  EXPECT_EQ(findCode("/v1/jobs",
                     bob_,
                     {{"trial", own_trial},
                      {"settings", {{"scale", {{"marker_set", ids.at("marker_sets")}}}}}}),
            "marker_set.not_found");
  EXPECT_EQ(findCode("/v1/trials",
                     bob_,
                     {{"mass_kg", 70}, {"height_m", 1.7}, {"marker_set", ids.at("marker_sets")}}),
            "marker_set.not_found");
  EXPECT_EQ(findCode("/v1/jobs", bob_, {{"trial", own_trial}}), "status 202");
}

TEST_F(IsolationTest, SameBytesOfTwoTenantsAreTwoTrials) {
  const std::string of_alice = fixture_.addTrial(alice_, "same bytes");
  const std::string of_bob = fixture_.addTrial(bob_, "same bytes");
  ports_.trials.remove(alice_, of_alice);
  EXPECT_EQ(readSource(*ports_.trials.findFile(bob_, of_bob, "markers").bytes), "same bytes");
}

// The same routes over a socket, with keys.
class ScopeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    api::ServerOptions options;
    options.authenticate = [this](const std::string& header) {
      return fixture_.services().keyCache().authenticate(header);
    };
    options.spool_folder = fixture_.folder().path();
    server_.emplace(routes_, options, [](api::LogLevel, const std::string&) {});
    port_ = server_->bind();
    thread_ = std::thread([this] { server_->run(); });
  }
  void TearDown() override {
    server_->stop();
    thread_.join();
  }
  std::string addKey(const std::vector<std::string>& scopes) {
    return fixture_.ports().keys.add(makeMember("lab"), "k", scopes).secret;
  }

  // Status of the route's answer with this token, or without one if it is empty.
  int ask(const api::Route& route, const std::string& token) const {
    std::string path = route.pattern;
    for (std::size_t open = 0; (open = path.find('{')) != std::string::npos;) {
      path.replace(open, path.find('}') - open + 1, "x");
    }
    std::string request = route.method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n";
    if (!token.empty()) {
      request += "Authorization: Bearer " + token + "\r\n";
    }
    if (route.method == "POST" || route.method == "PUT") {
      request += std::string("Content-Type: ") +
                 (route.body == api::BodyKind::kMultipart ? "multipart/form-data; boundary=x"
                                                          : "application/json") +
                 "\r\nContent-Length: 2\r\n";
      request += "Connection: close\r\n\r\n{}";
    } else {
      request += "Connection: close\r\n\r\n";
    }
    const std::string reply = HttpClient(port_).sendRaw(request);
    return reply.size() < 12 ? 0 : std::stoi(reply.substr(9, 3));
  }

  PortFixture fixture_;
  api::Ports ports_ = fixture_.ports();
  api::Routes routes_ = api::makeRoutes(ports_, "test");
  std::optional<api::Server> server_;
  int port_ = 0;
  std::thread thread_;
};

const char* scopeName(api::Scope scope) {
  switch (scope) {
    case api::Scope::kRead:
      return "read";
    case api::Scope::kWrite:
      return "write";
    case api::Scope::kAdmin:
      return "admin";
    case api::Scope::kNone:
      break;
  }
  return "";
}

TEST_F(ScopeTest, EveryRouteAsksForAKeyAndForItsScope) {
  const std::map<std::string, std::string> lacking = {{"read", addKey({"write", "admin"})},
                                                      {"write", addKey({"read", "admin"})},
                                                      {"admin", addKey({"read", "write"})}};
  for (const api::Route& route : routes_) {
    if (route.scope == api::Scope::kNone) {
      continue;
    }
    const std::string what = route.method + " " + route.pattern;
    EXPECT_EQ(ask(route, ""), 401) << what;
    std::string wrong = lacking.at(scopeName(route.scope));
    wrong.back() = wrong.back() == '0' ? 'g' : '0';
    EXPECT_EQ(ask(route, wrong), 401) << what << " with a secret whose last letter is wrong";
    EXPECT_EQ(ask(route, lacking.at(scopeName(route.scope))), 403) << what;
  }
}

TEST_F(ScopeTest, OnlyHealthDocumentsAndTheVersionAreOpen) {
  std::set<std::string> open;
  for (const api::Route& route : routes_) {
    if (route.scope == api::Scope::kNone) {
      EXPECT_EQ(route.method, "GET") << route.pattern;
      open.insert(route.pattern);
    }
  }
  for (const std::string& pattern : open) {
    EXPECT_TRUE(pattern.rfind("/v1/", 0) != 0 || pattern == "/v1/version") << pattern;
  }
}

TEST_F(ScopeTest, KeyWithTheScopePasses) {
  const std::string token = addKey({"read"});
  for (const api::Route& route : routes_) {
    if (route.scope == api::Scope::kRead && route.pattern.find('{') == std::string::npos) {
      // A comparison is let in, and then asks which jobs.
      EXPECT_EQ(ask(route, token), isComparison(route) ? 422 : 200) << route.pattern;
    }
  }
}

}  // namespace
}  // namespace gaitmill
