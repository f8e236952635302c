#include "api/router.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gaitmill::api {
namespace {

Router makeRouter() {
  return Router({{"GET", "/v1/jobs/{id}", BodyKind::kNone, {}},
                 {"POST", "/v1/jobs/{id}/cancel", BodyKind::kNone, {}},
                 {"DELETE", "/v1/jobs/{id}", BodyKind::kNone, {}}});
}

TEST(Router, CapturesOneSegment) {
  const Router router = makeRouter();
  const RouteMatch match = router.find("POST", "/v1/jobs/job_1/cancel");
  ASSERT_NE(match.route, nullptr);
  EXPECT_EQ(match.route->pattern, "/v1/jobs/{id}/cancel");
  EXPECT_EQ(match.captures.at("id"), "job_1");
}

TEST(Router, NamesTheMethodsOfAKnownPath) {
  const RouteMatch match = makeRouter().find("PUT", "/v1/jobs/job_1");
  EXPECT_EQ(match.route, nullptr);
  EXPECT_EQ(match.methods, (std::vector<std::string>{"GET", "DELETE"}));
}

class UnknownPath : public ::testing::TestWithParam<std::string> {};
TEST_P(UnknownPath, HasNoRouteAndNoMethods) {
  const RouteMatch match = makeRouter().find("GET", GetParam());
  EXPECT_EQ(match.route, nullptr);
  EXPECT_TRUE(match.methods.empty());
}
INSTANTIATE_TEST_SUITE_P(Table,
                         UnknownPath,
                         ::testing::Values("",
                                           "/",
                                           "/v1/jobs",
                                           "/v1/jobs/",
                                           "/v1/jobs/job_1/",
                                           "/v1//job_1",
                                           "v1/jobs/job_1",
                                           "/v1/jobs/..",
                                           "/v1/jobs/.hidden",
                                           "/v1/jobs/a b",
                                           "/v1/jobs/a%00b",
                                           "/v1/jobs/../jobs/x",
                                           "/v1/jobs/" + std::string(101, 'a')));

}  // namespace
}  // namespace gaitmill::api
