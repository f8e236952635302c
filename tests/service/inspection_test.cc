#include "service/inspection.h"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

api::UploadedFile readSample(const std::string& path) {
  std::ifstream file("models/" + path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return {path.substr(path.rfind('/') + 1), api::makeByteSource(bytes.str())};
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
  EXPECT_EQ(markers.units, "m");
  ASSERT_FALSE(view.files[1].contacts.empty());
  for (const api::ContactView& contact : view.files[1].contacts) {
    EXPECT_EQ(contact.foot, contact.plate == "ground_force_r" ? "right" : "left") << contact.plate;
    EXPECT_LT(contact.strike, contact.toe_off);
  }
  ASSERT_FALSE(view.events.empty());
  for (std::size_t i = 1; i < view.events.size(); ++i) {
    EXPECT_LE(view.events[i - 1].time, view.events[i].time);
  }
  EXPECT_EQ(view.files[2].labels_kind, "columns");
  EXPECT_EQ(view.files[2].format, "table");
  ASSERT_TRUE(view.files[2].emg.has_value());
  EXPECT_EQ(view.files[2].emg->source, "envelope");
  ASSERT_EQ(view.files[2].emg->channels.size(), 10U);
  EXPECT_EQ(view.files[2].emg->channels[0].channel, "SOL");
  EXPECT_EQ(view.files[2].emg->channels[0].side, "right");
  EXPECT_EQ(view.files[2].emg->channels[0].muscles, std::vector<std::string>{"soleus_r"});
  EXPECT_EQ(view.files[3].labels.size(), 80U);
}

// What every marker was taken for, what is stated wins, and what is stated of nobody is said.
TEST(InspectTrial, SaysWhichLandmarkEachMarkerIs) {
  api::TrialUpload upload;
  upload.files = {{"markers", readSample("sample/markers.trc")},
                  {"marker_names", {"names.json", api::makeByteSource(R"({"RTH1": null})")}}};
  const api::TrialView view = inspectTrial(upload);
  ASSERT_TRUE(view.marker_names.has_value());
  EXPECT_EQ(view.marker_names->set, "rajagopal2016");
  EXPECT_EQ(view.marker_names->markers.size(), 42U);
  EXPECT_TRUE(view.marker_names->missing.empty());
  for (const api::MarkerNameView& name : view.marker_names->markers) {
    EXPECT_EQ(name.landmark, name.measured == "RTH1" ? "" : name.measured);
  }
  EXPECT_EQ(view.files.back().part, "marker_names");
  EXPECT_EQ(view.files.back().format, "json");

  upload.files["marker_names"].bytes = api::makeByteSource(R"({"M1": "RASI"})");
  EXPECT_EQ(inspectTrial(upload).warnings.back(), "marker_names.M1: no marker 'M1' was measured");
  upload.files["marker_names"].bytes = api::makeByteSource(R"({"RASI": "RASY"})");
  EXPECT_THROW(inspectTrial(upload), Error);
}

TEST(InspectTrial, SaysWhatAnAnalogFileHolds) {
  std::string text =
      "File_Type:\tAnalog R/C ASCII\nBitDepth:\t16\tPreciseRate:\t1000\n\n"
      "Name\tF1X\tL_TA\tEMG 7\t\nRate\t1000\t1000\t1000\t\nRange\t5000\t2500\t2500\t\n";
  for (int i = 0; i < 100; ++i) {
    const std::string count = std::to_string(i * 37 % 11 - 5);
    text += std::to_string(0.001 * i) + "\t1\t" + count + "\t" + count + "\t\n";
  }
  api::TrialUpload upload;
  upload.files["emg"] = {"emg.anc", api::makeByteSource(text)};
  const api::TrialView view = inspectTrial(upload);
  EXPECT_EQ(view.files[0].format, "anc");
  EXPECT_NEAR(view.files[0].rate.value(), 1000.0, tol(1e-6));
  EXPECT_EQ(view.files[0].frames, 100);
  const api::EmgView& emg = view.files[0].emg.value();
  EXPECT_EQ(emg.source, "raw");
  EXPECT_EQ(emg.force_channels, std::vector<std::string>{"F1X"});
  ASSERT_EQ(emg.channels.size(), 2U);
  EXPECT_EQ(emg.channels[0].side, "left");
  EXPECT_EQ(emg.channels[0].muscles, std::vector<std::string>{"tibant_l"});
  EXPECT_TRUE(emg.channels[1].muscles.empty());
  ASSERT_EQ(view.warnings.size(), 1U);
  EXPECT_NE(view.warnings[0].find("'EMG 7'"), std::string::npos);
}

// Markers, one plate, one channel of EMG and an event in one file.
TEST(InspectTrial, SaysWhatAC3dFileHolds) {
  C3dWriter writer;
  writer.subframes = 2;
  for (int k = 0; k < 50; ++k) {
    writer.points.push_back({100.0 + k, 200, 900, 0, 400, 500, 600, k < 5 ? -1.0 : 0.0});
    const std::vector<double> sample = {0, 0, -400, 0, 0, 0, 0.1};
    writer.analog.insert(writer.analog.end(), 2, sample);
  }
  writer.addPointGroup({"RASI", "LASI"});
  writer.addAnalogGroup({"Fx", "Fy", "Fz", "Mx", "My", "Mz", "SOL"},
                        {"N", "N", "N", "Nmm", "Nmm", "Nmm", "V"});
  writer.addPlate(2, {400, 600, 0, 0, 600, 0, 0, 0, 0, 400, 0, 0}, {0, 0, -40}, 6);
  writer.addWords("EVENT", "USED", {}, {1});
  writer.addTexts("EVENT", "LABELS", {"Foot Strike"});
  writer.addTexts("EVENT", "CONTEXTS", {"Left"});
  writer.addReals("EVENT", "TIMES", {2, 1}, {0, 0.25});
  const api::UploadedFile upload{"walk.c3d", api::makeByteSource(writer.write())};
  const api::TrialView view =
      inspectTrial({{}, {{"markers", upload}, {"grf", upload}, {"emg", upload}}, ""});
  ASSERT_EQ(view.files.size(), 3U);
  const api::UnderstoodFile& markers = view.files[0];
  EXPECT_EQ(markers.format, "c3d");
  EXPECT_EQ(markers.units, "mm");
  EXPECT_EQ(markers.frames, 50);
  EXPECT_EQ(markers.labels, (std::vector<std::string>{"RASI", "LASI"}));
  ASSERT_TRUE(markers.recording.has_value());
  ASSERT_EQ(markers.recording->plates.size(), 1U);
  EXPECT_EQ(markers.recording->plates[0].type, 2);
  EXPECT_EQ(markers.recording->plates[0].refusal, "");
  EXPECT_EQ(markers.recording->analog_channels, std::vector<std::string>{"SOL"});
  EXPECT_EQ(markers.recording->analog_rate, 200);
  ASSERT_EQ(markers.recording->events.size(), 1U);
  EXPECT_EQ(markers.recording->events[0].context, "Left");
  ASSERT_EQ(markers.marker_faults.size(), 1U);
  EXPECT_EQ(markers.marker_faults[0].fault, "gap");
  EXPECT_EQ(markers.marker_faults[0].marker, "LASI");
  EXPECT_EQ(markers.marker_faults[0].frames, 5);
  EXPECT_EQ(view.files[1].format, "c3d");
  EXPECT_EQ(view.files[1].labels, std::vector<std::string>{"plate_1"});
  EXPECT_NEAR(view.files[1].rate.value(), 200.0, tol(1e-6));
  EXPECT_EQ(view.files[2].format, "c3d");
  EXPECT_EQ(view.files[2].labels, std::vector<std::string>{"SOL"});
}

TEST(InspectTrial, NamesPartFileAndPlaceOfAFault) {
  api::TrialUpload upload;
  upload.files["grf"] = {"forces.mot", api::makeByteSource("this is\nnot a table\n")};
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
  upload.files["grf"] = {
      "forces.sto",
      api::makeByteSource("x\nversion=1\nnRows=1\nnColumns=2\nendheader\ntime\ta\n0\t1\n")};
  try {
    inspectTrial(upload);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kGrfColumns);
  }
}

TEST(InspectTrial, ForcesThatNeverLoadAPlateAreAWarning) {
  api::TrialUpload upload;
  upload.files["grf"] = {
      "forces.sto",
      api::makeByteSource("x\nversion=1\nendheader\n"
                          "time\tground_force_r_vx\tground_force_r_vy\tground_force_r_vz"
                          "\tground_force_r_px\tground_force_r_py\tground_force_r_pz\n"
                          "0\t0\t0\t0\t0\t0\t0\n0.1\t0\t0\t0\t0\t0\t0\n")};
  const api::TrialView view = inspectTrial(upload);
  EXPECT_EQ(view.files[0].labels, std::vector<std::string>{"ground_force_r"});
  EXPECT_TRUE(view.files[0].contacts.empty());
  ASSERT_FALSE(view.warnings.empty());
}

}  // namespace
}  // namespace gaitmill
