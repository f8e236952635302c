#include "api/dto/image.h"

#include <map>
#include <optional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill::api {
namespace {

using Parameters = std::map<std::string, std::string>;

ImageRequest parse(ImageKind kind, const Parameters& parameters) {
  return parseImageRequest(kind, [&parameters](const std::string& name) {
    const auto found = parameters.find(name);
    return found == parameters.end() ? std::nullopt : std::optional<std::string>(found->second);
  });
}

Error errorOf(ImageKind kind, const Parameters& parameters) {
  try {
    parse(kind, parameters);
  } catch (const Error& error) {
    return error;
  }
  return {ErrorCode::kInternal, "nothing was thrown"};
}

TEST(ImageRequest, NothingAskedIsTheWholePictureFromTheSide) {
  const ImageRequest request = parse(ImageKind::kPose, {});
  EXPECT_EQ(request.width, 1280);
  EXPECT_EQ(request.height, 720);
  EXPECT_EQ(request.view, "sagittal");
  EXPECT_EQ(request.color, "activation");
  EXPECT_TRUE(request.bones && request.muscles && request.markers && request.forces &&
              request.ground && request.legend);
  EXPECT_FALSE(request.time || request.percent || request.start || request.end);
}

TEST(ImageRequest, ReadsEveryParameter) {
  const ImageRequest pose = parse(ImageKind::kPose,
                                  {{"percent", "12.5"},
                                   {"width", "400"},
                                   {"height", "300"},
                                   {"view", "30,-10"},
                                   {"color", "force"},
                                   {"bones", "false"},
                                   {"muscles", "0"},
                                   {"markers", "off"},
                                   {"forces", "true"},
                                   {"ground", "1"},
                                   {"legend", "on"}});
  EXPECT_EQ(pose.percent, 12.5);
  EXPECT_EQ(pose.width, 400);
  EXPECT_EQ(pose.height, 300);
  EXPECT_EQ(pose.view, "30,-10");
  EXPECT_EQ(pose.color, "force");
  EXPECT_FALSE(pose.bones || pose.muscles || pose.markers);
  EXPECT_TRUE(pose.forces && pose.ground && pose.legend);
  EXPECT_EQ(parse(ImageKind::kPose, {{"time", "-0.25"}}).time, -0.25);
  const ImageRequest strip =
      parse(ImageKind::kStrip, {{"start", "0.5"}, {"end", "1.5"}, {"poses", "9"}});
  EXPECT_EQ(strip.start, 0.5);
  EXPECT_EQ(strip.end, 1.5);
  EXPECT_EQ(strip.poses, 9);
  const ImageRequest film = parse(ImageKind::kAnimation, {{"rate", "12"}, {"slow_down", "4"}});
  EXPECT_EQ(film.rate, 12);
  EXPECT_EQ(film.slow_down, 4);
}

struct BadParameter {
  ImageKind kind;
  const char* name;
  const char* value;
};
class BadImageParameter : public ::testing::TestWithParam<BadParameter> {};
TEST_P(BadImageParameter, IsNamedWithWhatIsExpected) {
  const BadParameter& bad = GetParam();
  const Error error = errorOf(bad.kind, {{bad.name, bad.value}});
  EXPECT_EQ(error.code(), ErrorCode::kRequestField);
  EXPECT_EQ(error.where().field, bad.name);
  EXPECT_NE(error.message().find("must be"), std::string::npos) << error.message();
}
INSTANTIATE_TEST_SUITE_P(All,
                         BadImageParameter,
                         ::testing::Values(BadParameter{ImageKind::kPose, "time", "now"},
                                           BadParameter{ImageKind::kPose, "time", "nan"},
                                           BadParameter{ImageKind::kPose, "time", "1e999"},
                                           BadParameter{ImageKind::kPose, "time", ""},
                                           BadParameter{ImageKind::kPose, "time", "1 "},
                                           BadParameter{ImageKind::kPose, "percent", "101"},
                                           BadParameter{ImageKind::kPose, "width", "15"},
                                           BadParameter{ImageKind::kPose, "width", "4097"},
                                           BadParameter{ImageKind::kPose, "width", "99999999999"},
                                           BadParameter{ImageKind::kPose, "height", "100.5"},
                                           BadParameter{ImageKind::kPose, "color", "colour"},
                                           BadParameter{ImageKind::kPose, "bones", "yes"},
                                           BadParameter{ImageKind::kStrip, "poses", "0"},
                                           BadParameter{ImageKind::kStrip, "poses", "25"},
                                           BadParameter{ImageKind::kAnimation, "rate", "0"},
                                           BadParameter{ImageKind::kAnimation, "rate", "61"},
                                           BadParameter{ImageKind::kAnimation, "slow_down", "0"}));

TEST(ImageRequest, TimeAndPercentExcludeEachOther) {
  EXPECT_EQ(errorOf(ImageKind::kPose, {{"time", "1"}, {"percent", "1"}}).where().field, "percent");
}

TEST(ImageRequest, EndComesAfterTheStart) {
  EXPECT_EQ(errorOf(ImageKind::kStrip, {{"start", "1"}, {"end", "1"}}).where().field, "end");
}

TEST(ImageRequest, WrongColorNamesTheNearest) {
  EXPECT_NE(errorOf(ImageKind::kPose, {{"color", "fibre_length"}}).message().find("fiber_length"),
            std::string::npos);
}

// Two images are described alike only if they are alike.
TEST(ImageRequest, EveryParameterChangesTheDescription) {
  std::set<std::string> descriptions = {describeImage(parse(ImageKind::kPose, {}))};
  const Parameters others = {{"time", "1"},
                             {"percent", "1"},
                             {"width", "400"},
                             {"height", "300"},
                             {"view", "frontal"},
                             {"color", "none"},
                             {"bones", "0"},
                             {"muscles", "0"},
                             {"markers", "0"},
                             {"forces", "0"},
                             {"ground", "0"},
                             {"legend", "0"}};
  for (const auto& [name, value] : others) {
    descriptions.insert(describeImage(parse(ImageKind::kPose, {{name, value}})));
  }
  EXPECT_EQ(descriptions.size(), others.size() + 1);
  EXPECT_EQ(imageParameters(ImageKind::kPose).size(), others.size());
  const Parameters moving = {{"start", "0.1"}, {"end", "9"}, {"rate", "7"}, {"slow_down", "3"}};
  std::set<std::string> films = {describeImage(parse(ImageKind::kAnimation, {}))};
  for (const auto& [name, value] : moving) {
    films.insert(describeImage(parse(ImageKind::kAnimation, {{name, value}})));
  }
  EXPECT_EQ(films.size(), moving.size() + 1);
}

}  // namespace
}  // namespace gaitmill::api
