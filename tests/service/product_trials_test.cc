#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/service/product_service.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using nlohmann::json;

/// Files of one laboratory below ../shared/data, by part.
struct Recording {
  double mass;
  double height;
  std::vector<std::pair<std::string, std::string>> files;
};

const std::vector<Recording>& recordings() {
  static const std::vector<Recording> all = {
      {85.0668,
       1.829,
       {{"static", "walk/static_walk_1.trc"},
        {"static2", "walk/static_walk_2.trc"},
        {"markers", "walk/motion_capture_walk.trc"},
        {"grf", "walk/grf_walk.mot"}}},
      {72.84,
       1.8,
       {{"static", "run/paper_subject01/static_run.trc"},
        {"markers", "run/paper_subject01/motion_capture_run.trc"},
        {"grf", "run/paper_subject01/grf_run.mot"}}},
      {65.9,
       1.83,
       {{"static", "run/hamner2010/subject02_static.trc"},
        {"markers", "run/hamner2010/subject02_running.trc"},
        {"grf", "run/hamner2010/subject02_running_grf.mot"}}},
      {80.47,
       1.772,
       {{"markers", "run/hamner2013_subject04/run400/markers.trc"},
        {"grf", "run/hamner2013_subject04/run400/grf.mot"}}}};
  return all;
}

class ProductTrials : public SharedDataTest {
 protected:
  std::string upload(const HttpClient& client, const Recording& recording) {
    const json subject{{"mass_kg", recording.mass}, {"height_m", recording.height}};
    std::vector<ClientPart> parts = {{"trial", "", subject.dump()}};
    for (const auto& [part, path] : recording.files) {
      parts.push_back({part, path.substr(path.rfind('/') + 1), readBytes(shared("data/" + path))});
    }
    const ClientReply reply = client.upload("/v1/trials", parts);
    EXPECT_EQ(reply.status, 201) << reply.body;
    const json trial = reply.json();
    EXPECT_TRUE(trial["marker_names"]["missing"].empty()) << trial["marker_names"]["missing"];
    EXPECT_NE(trial["gait"]["window"], nullptr);
    return trial["id"];
  }
};

// Four laboratories' raw files, one request, no settings.
TEST_F(ProductTrials, OneStudyTakesAllLaboratoriesFromRawFilesToActivations) {
  const TemporaryFolder folder;
  const ProductService service(folder, "2");
  json request{{"name", "four laboratories"}, {"trials", json::array()}};
  for (const Recording& recording : recordings()) {
    request["trials"].push_back(upload(service.client(), recording));
  }
  const ClientReply reply = service.client().post("/v1/studies", request.dump());
  ASSERT_EQ(reply.status, 202) << reply.body;
  const json study = reply.json();
  ASSERT_EQ(study["jobs"].size(), recordings().size());
  for (const json& id : study["jobs"]) {
    const json job = service.client().waitForState(id.get<std::string>(), {"succeeded", "failed"});
    EXPECT_EQ(job["state"], "succeeded") << job;
    const ClientReply activations = service.client().get(
        "/v1/jobs/" + id.get<std::string>() + "/results/activations?format=csv&axis=cycle");
    EXPECT_EQ(activations.status, 200) << activations.body;
  }
  const json finished =
      service.client().get("/v1/studies/" + study["id"].get<std::string>()).json();
  EXPECT_TRUE(finished["finished"].get<bool>());
  EXPECT_EQ(finished["job_counts"]["succeeded"], recordings().size());
}

}  // namespace
}  // namespace gaitmill
