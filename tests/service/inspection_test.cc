#include "service/inspection.h"

#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

api::UploadedFile readSample(const std::string& path) {
  std::ifstream file("models/" + path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return {path.substr(path.rfind('/') + 1), bytes.str()};
}

TEST(InspectTrial, SaysWhatTheSampleTrialHolds) {
  api::TrialUpload upload;
  upload.files = {{"markers", readSample("sample/markers.trc")},
                  {"grf", readSample("sample/grf.mot")},
                  {"emg", readSample("sample/emg.sto")},
                  {"model", readSample("rajagopal2016/rajagopal2016.osim")}};
  const api::TrialView view = inspectTrial(upload);
  ASSERT_EQ(view.files.size(), 4U);
  const api::UnderstoodFile& markers = view.files[0];
  EXPECT_EQ(markers.part, "markers");
  EXPECT_EQ(markers.name, "markers.trc");
  EXPECT_EQ(markers.format, "trc");
  EXPECT_EQ(markers.labels.size(), 42U);
  EXPECT_NEAR(markers.rate.value(), 100.0, tol(1e-9));
  EXPECT_EQ(markers.start, 0.0);
  EXPECT_NEAR(markers.end.value(), (markers.frames.value() - 1) / 100.0, tol(1e-9));
  EXPECT_EQ(view.files[1].part, "grf");
  EXPECT_EQ(view.files[1].labels.size(), 2U);
  EXPECT_NEAR(view.files[1].rate.value(), 200.0, tol(1e-6));
  EXPECT_EQ(view.files[2].labels_kind, "columns");
  EXPECT_EQ(view.files[3].labels.size(), 80U);
}

TEST(InspectTrial, NamesPartFileAndPlaceOfAFault) {
  api::TrialUpload upload;
  upload.files["grf"] = {"forces.mot", "this is\nnot a table\n"};
  try {
    inspectTrial(upload);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where().file, "forces.mot");
    EXPECT_GT(error.where().line, 0);
    EXPECT_EQ(error.context().back(), "reading the part 'grf'");
  }
}

TEST(InspectTrial, ForceTablesNeedForces) {
  api::TrialUpload upload;
  upload.files["grf"] = {"forces.sto",
                         "x\nversion=1\nnRows=1\nnColumns=2\nendheader\ntime\ta\n0\t1\n"};
  try {
    inspectTrial(upload);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kGrfColumns);
  }
}

}  // namespace
}  // namespace gaitmill
