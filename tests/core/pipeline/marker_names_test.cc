#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/pipeline/marker_names_json.h"
#include "core/pipeline/pipeline.h"
#include "tests/support/sample_input.h"

namespace gaitmill {
namespace {

/// What a job is refused with: code and sentence; empty if it was not.
struct Refusal {
  std::string code;
  std::string field;
  std::string message;
};

Refusal runRefused(const TrialInput& input, const std::string& settings) {
  try {
    Pipeline().run(input, {"settings", settings}, {});
  } catch (const Error& error) {
    return {std::string(codeName(error.code())), error.where().field, error.message()};
  }
  return {};
}

/// The names in the fourth line of a TRC file replaced by M1, M2, ...
void forgetNames(InputFile& trc) {
  std::size_t start = 0;
  for (int line = 0; line < 3; ++line) {
    start = trc.bytes.find('\n', start) + 1;
  }
  const std::size_t end = trc.bytes.find('\n', start);
  const std::string names = trc.bytes.substr(start, end - start);
  std::string renamed;
  int cell = 0;
  int marker = 0;
  for (std::size_t at = 0; at <= names.size(); ++cell) {
    const std::size_t tab = std::min(names.find('\t', at), names.size());
    const std::string text = names.substr(at, tab - at);
    const bool is_name = cell >= 2 && text.find_first_not_of(" \r") != std::string::npos;
    renamed += (at == 0 ? "" : "\t") + (is_name ? "M" + std::to_string(++marker) : text);
    at = tab + 1;
  }
  trc.bytes.replace(start, end - start, renamed);
}

const char* const kOnlyIk = R"({"stages": {"last": "ik"}, "scale": {"marker_set": "auto"}})";

// Complaint "unknown marker names": the answer says what was told, what is missing, and where to
// state it, instead of scaling without markers.
TEST(MarkerNamesJob, UnknownNamesAreRefusedWithWhatIsMissing) {
  TrialInput input = readSampleInput();
  forgetNames(*input.static_markers);
  forgetNames(*input.markers);
  const Refusal refusal = runRefused(input, kOnlyIk);
  EXPECT_EQ(refusal.code, "markers.missing");
  EXPECT_EQ(refusal.field, "trial.marker_names");
  for (const char* part : {"pelvis (0 of 3", "right knee", "left ankle", "trunk", "M1 "}) {
    EXPECT_NE(refusal.message.find(part), std::string::npos) << part << ": " << refusal.message;
  }
}

TEST(MarkerNamesJob, StatedNamesAreHeldAgainstTheFiles) {
  const TrialInput input = readSampleInput();
  const Refusal refusal = runRefused(
      input, R"({"trial": {"marker_names": {"RASII": "RASI"}}, "stages": {"last": "ik"}})");
  EXPECT_EQ(refusal.code, "markers.names");
  EXPECT_EQ(refusal.field, "marker_names.RASII");
  EXPECT_EQ(refusal.message, "no marker 'RASII' was measured, did you mean 'RASI'?");
}

TEST(MarkerNamesJson, NamesTheFieldAndTheNearestLandmark) {
  EXPECT_EQ(readMarkerNames({"names.json", R"({"M1": "RASI", "M2": null})"}),
            (MarkerOverrides{{"M1", "RASI"}, {"M2", std::nullopt}}));
  try {
    readMarkerNames({"names.json", R"({"M1": "RASSI"})"});
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMarkerNames);
    EXPECT_EQ(error.where().field, "marker_names.M1");
    EXPECT_EQ(error.message(), "there is no landmark 'RASSI', did you mean 'RASI'?");
  }
  EXPECT_THROW(readMarkerNames({"names.json", R"({"M1": 3})"}), Error);
  EXPECT_THROW(readMarkerNames({"names.json", R"(["M1"])"}), Error);
}

// The same bits whether a trial's own part says what a marker is or nobody needs to.
TEST(MarkerNamesJob, PartOfTheTrialIsReadUnderTheSettings) {
  TrialInput input = readSampleInput();
  input.marker_names = InputFile{"names.json", R"({"nobody": "RASI"})"};
  EXPECT_EQ(runRefused(input, R"({"stages": {"last": "ik"}})").code, "markers.names");
}

}  // namespace
}  // namespace gaitmill
