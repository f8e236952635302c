// Models, marker sets, settings, keys and the service's own routes.

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/api/route_fixture.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

class CatalogRoutes : public RouteFixture {};

TEST_F(CatalogRoutes, DocumentIsTakenUnderItsName) {
  HttpRequest request;
  request.body = makeByteSource("<OpenSimDocument/>");
  request.query["name"] = "../lab model";
  const HttpReply reply = call("POST", "/v1/models", request);
  EXPECT_EQ(reply.status, 201);
  EXPECT_EQ(reply.headers.at("Location"), std::string("/v1/models/") + kModelId);
  EXPECT_EQ(stub_.record.calls.back(), "add model lab model");
  EXPECT_EQ(stub_.record.document, "<OpenSimDocument/>");
  EXPECT_EQ(json::parse(reply.body)["summary"]["muscles"], 80);
  call("POST", "/v1/marker_sets", request);
  EXPECT_EQ(stub_.record.calls.back(), "add marker set lab model");
}

TEST_F(CatalogRoutes, DocumentWithoutANameIsRefused) {
  EXPECT_EQ(errorOf([&] { post("/v1/models", "x"); }).where().field, "name");
}

TEST_F(CatalogRoutes, ShippedEntriesAreFoundByName) {
  get("/v1/models/rajagopal2016");
  EXPECT_EQ(stub_.record.calls.back(), "find model rajagopal2016");
  get("/v1/marker_sets/paper_walk/document");
  EXPECT_EQ(stub_.record.calls.back(), "find document paper_walk");
}

TEST_F(CatalogRoutes, SettingsAreListedAndServedWhole) {
  EXPECT_EQ(json::parse(get("/v1/settings").body)["items"][1]["name"], "paper_walk");
  EXPECT_EQ(get("/v1/settings/defaults").body, R"({"ik":{}})");
  EXPECT_EQ(stub_.record.calls.back(), "find settings defaults");
}

TEST_F(CatalogRoutes, SecretIsShownOnceAndNeverKept) {
  const std::string body = R"({"name": "lab", "scopes": ["read", "write"]})";
  const HttpReply reply = post("/v1/keys", body);
  EXPECT_EQ(reply.status, 201);
  EXPECT_EQ(reply.headers.at("Cache-Control"), "no-store");
  EXPECT_EQ(json::parse(reply.body)["secret"], "gm_secret");
  EXPECT_FALSE(json::parse(get("/v1/keys").body)["items"][0].contains("secret"));
  EXPECT_EQ(errorOf([&] {
              post("/v1/keys", body, {{"idempotency-key", "k"}});
            })
                .where()
                .field,
            "Idempotency-Key");
}

TEST_F(CatalogRoutes, KeysTakeKnownScopesOnly) {
  for (const char* body : {R"({"name": "lab"})",
                           R"({"name": "lab", "scopes": []})",
                           R"({"name": "lab", "scopes": ["root"]})",
                           R"({"name": "lab", "scopes": "read"})",
                           R"({"name": "", "scopes": ["read"]})"}) {
    EXPECT_EQ(errorOf([&] { post("/v1/keys", body); }).code(), ErrorCode::kRequestField) << body;
  }
}

TEST_F(CatalogRoutes, VersionIsThatOfTheBinary) {
  EXPECT_EQ(get("/v1/version").body, R"({"name":"gaitmill","version":"1.2.3"})");
}

TEST_F(CatalogRoutes, ReadinessSaysWhatIsMissing) {
  EXPECT_EQ(get("/readyz").status, 200);
  stub_.record.unreadiness = "the disk is full";
  const Error error = errorOf([&] { get("/readyz"); });
  EXPECT_EQ(error.code(), ErrorCode::kServiceUnready);
  EXPECT_EQ(error.message(), "the disk is full");
  EXPECT_EQ(get("/livez", {{"probe", "7"}}).status, 200);
}

TEST_F(CatalogRoutes, MetricsAreTextForPrometheus) {
  EXPECT_EQ(get("/metrics").content_type, "text/plain; version=0.0.4; charset=utf-8");
}

}  // namespace
}  // namespace gaitmill::api
