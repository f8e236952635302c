#include "api/dto/object_reader.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill::api {
namespace {

template <class Call>
Error errorOf(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return Error(ErrorCode::kInternal, "nothing was thrown");
}

TEST(ParseJson, SaysLineAndColumn) {
  const Error error = errorOf([] { parseJson("{\n  \"a\": 1,\n  \"b\" 2}", "job"); });
  EXPECT_EQ(error.code(), ErrorCode::kRequestMalformed);
  EXPECT_EQ(error.where().file, "job");
  EXPECT_EQ(error.where().line, 3);
  EXPECT_EQ(error.where().column, 7);
}

class BadJson : public ::testing::TestWithParam<std::string> {};
TEST_P(BadJson, IsRefused) {
  EXPECT_EQ(errorOf([] { parseJson(GetParam(), "job"); }).code(), ErrorCode::kRequestMalformed);
}
INSTANTIATE_TEST_SUITE_P(Table,
                         BadJson,
                         ::testing::Values("",
                                           " ",
                                           "{",
                                           "[1,]",
                                           "{\"a\":1}}",
                                           "{'a': 1}",
                                           "{\"a\": 1e999}",
                                           "{\"a\": NaN}",
                                           "\"\xff\"",
                                           std::string("{\"a\": \0}", 8),
                                           std::string(65, '[') + std::string(65, ']'),
                                           std::string(100000, '[')));

TEST(ObjectReader, NamesTheFieldThatIsMissingWrongOrUnknown) {
  const auto object = nlohmann::json::parse(R"({"mass_kg": "heavy", "heigth_m": 1.7})");
  ObjectReader reader(object, "trial");
  EXPECT_EQ(errorOf([&] {
              reader.number("mass_kg", {5, 300, "kg"});
            })
                .where()
                .field,
            "trial.mass_kg");
  EXPECT_EQ(errorOf([&] {
              reader.number("height_m", {0.4, 2.6, "m"});
            }).message(),
            "field 'height_m' is missing in 'trial'");
  EXPECT_EQ(errorOf([&] { reader.finish(); }).message(),
            "'trial' has no field 'heigth_m'; did you mean 'height_m'?");
}

TEST(ObjectReader, KeepsNumbersInRange) {
  const auto object = nlohmann::json::parse(R"({"low": 4.999, "edge": 5, "high": 300.001})");
  ObjectReader reader(object, "trial");
  EXPECT_EQ(reader.number("edge", {5, 300, "kg"}), 5.0);
  EXPECT_EQ(errorOf([&] {
              reader.number("high", {5, 300, "kg"});
            }).message(),
            "field 'high' must be a number from 5.0 to 300.0 kg, found 300.001");
  EXPECT_EQ(errorOf([&] {
              reader.number("low", {5, 300, "kg"});
            }).code(),
            ErrorCode::kRequestField);
}

TEST(ObjectReader, TextsAreNeitherEmptyNorEndless) {
  const nlohmann::json object{{"empty", ""}, {"long", std::string(201, 'a')}, {"null", nullptr}};
  ObjectReader reader(object, "job");
  EXPECT_EQ(errorOf([&] { reader.text("empty"); }).code(), ErrorCode::kRequestField);
  EXPECT_EQ(errorOf([&] { reader.text("long"); }).code(), ErrorCode::kRequestField);
  EXPECT_FALSE(reader.optionalText("null").has_value());
  EXPECT_FALSE(reader.optionalText("absent").has_value());
}

TEST(ObjectReader, TakesObjectsOnly) {
  for (const char* text : {"[]", "3", "null", "\"a\""}) {
    const auto value = nlohmann::json::parse(text);
    EXPECT_EQ(errorOf([&] { ObjectReader(value, "job"); }).where().field, "job") << text;
  }
}

}  // namespace
}  // namespace gaitmill::api
