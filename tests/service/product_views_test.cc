// What people look at, of the program itself: the sample trial's figures, images and report over a
// real socket, drawn by the real child.

#include <dirent.h>
#include <png.h>
#include <unistd.h>
#include <webp/mux.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/http/api_contract.h"
#include "tests/service/product_service.h"

namespace gaitmill {
namespace {

using nlohmann::json;

struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;

  // How many different colours there are, up to a thousand.
  std::size_t countColors() const {
    std::set<unsigned> colors;
    for (std::size_t i = 0; i + 2 < rgb.size() && colors.size() < 1000; i += 3) {
      colors.insert(rgb[i] * 65536U + rgb[i + 1] * 256U + rgb[i + 2]);
    }
    return colors.size();
  }
};

Pixels decodePng(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Pixels pixels;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    ADD_FAILURE() << image.message;
    return pixels;
  }
  image.format = PNG_FORMAT_RGB;
  pixels.rgb.resize(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr), 0)
      << image.message;
  pixels.width = static_cast<int>(image.width);
  pixels.height = static_cast<int>(image.height);
  return pixels;
}

int countFrames(const std::string& webp) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(webp.data()), webp.size()};
  WebPMux* mux = WebPMuxCreate(&data, 0);
  int frames = 0;
  if (mux != nullptr) {
    WebPMuxNumChunks(mux, WEBP_CHUNK_ANMF, &frames);
    WebPMuxDelete(mux);
  }
  return frames;
}

// [MiB] of a process.
double findResidentMemory(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
  double total = 0;
  double resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

// The child that draws, or -1.
pid_t findDrawingChild(pid_t parent) {
  pid_t found = -1;
  DIR* folder = ::opendir("/proc");
  while (const dirent* entry = ::readdir(folder)) {
    const pid_t pid = static_cast<pid_t>(std::atoi(entry->d_name));
    if (pid <= 0) {
      continue;
    }
    const std::string name = "/proc/" + std::to_string(pid);
    const std::string stat = readBytes(name + "/stat");
    const std::string command = readBytes(name + "/cmdline");
    const std::size_t state = stat.rfind(')');
    const bool is_child =
        state != std::string::npos && std::atoi(stat.c_str() + state + 4) == parent;
    if (is_child && command.find(std::string("\0draw\0", 6)) != std::string::npos) {
      found = pid;
    }
  }
  ::closedir(folder);
  return found;
}

/// One service with one finished job of the sample trial for all tests.
class ProductViews : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    // So little that the cache cannot pass for a leak, or hide one.
    service_ = std::make_unique<ProductService>(
        *folder_, "1", std::vector<std::string>{"--image-cache-mb", "1"});
    id_ = service_->submit(service_->uploadSample());
    const json job = service_->client().waitForState(id_, {"succeeded", "failed"});
    ASSERT_EQ(job["state"], "succeeded") << job.dump(2);
  }
  static void TearDownTestSuite() {
    service_.reset();
    folder_.reset();
  }

  static ClientReply get(const std::string& path,
                         const std::map<std::string, std::string>& headers = {}) {
    return service_->client().get("/v1/jobs/" + id_ + path, headers);
  }
  // The reply, held against the contract.
  static ClientReply check(const std::string& path, const std::string& pattern) {
    ClientReply reply = get(path);
    EXPECT_EQ(reply.status, 200) << path << reply.body;
    for (const auto& fault : contract().findFaults("GET", pattern, reply)) {
      ADD_FAILURE() << path << ": " << fault;
    }
    return reply;
  }
  static std::string tagOf(const ClientReply& reply) {
    for (const char* name : {"ETag", "etag"}) {
      const auto found = reply.headers.find(name);
      if (found != reply.headers.end()) {
        return found->second;
      }
    }
    return "";
  }
  static const ApiContract& contract() {
    static const ApiContract document;
    return document;
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static std::unique_ptr<ProductService> service_;
  static std::string id_;
};
std::unique_ptr<TemporaryFolder> ProductViews::folder_;
std::unique_ptr<ProductService> ProductViews::service_;
std::string ProductViews::id_;

TEST_F(ProductViews, EveryListedFigureComesInEveryForm) {
  const std::string pattern = "/v1/jobs/{id}/plots/{name}";
  const json list = check("/plots", "/v1/jobs/{id}/plots").json();
  std::set<std::string> names;
  for (const json& item : list["items"]) {
    const std::string name = item["name"];
    names.insert(name);
    EXPECT_EQ(item["url"], "/v1/jobs/" + id_ + "/plots/" + name);
    const ClientReply figure = check("/plots/" + name, pattern);
    EXPECT_TRUE(figure.json().contains("$schema")) << name;
    const json data = check("/plots/" + name + "?data=only", pattern).json();
    EXPECT_FALSE(data["panels"].empty()) << name;
    const ClientReply svg = check("/plots/" + name + "?format=svg", pattern);
    EXPECT_EQ(svg.body.find("<svg"), 0U) << name;
    EXPECT_EQ(get("/plots/" + name, {{"If-None-Match", tagOf(figure)}}).status, 304) << name;
  }
  for (const char* name : {"moments", "activations", "muscle_forces", "residuals"}) {
    EXPECT_EQ(names.count(name), 1U) << name << " of " << list.dump(1);
  }
}

TEST_F(ProductViews, UnknownFigureIsNotFoundWithTheNearestName) {
  const ClientReply reply = get("/plots/momments");
  EXPECT_EQ(reply.status, 404);
  EXPECT_EQ(reply.json()["code"], "figure.not_found");
  EXPECT_NE(reply.json()["detail"].get<std::string>().find("moments"), std::string::npos);
}

TEST_F(ProductViews, PosesDecodeInEveryViewAndColor) {
  const std::string pattern = "/v1/jobs/{id}/images/pose.png";
  std::set<std::string> different;
  for (const char* query : {"?width=400&height=300",
                            "?width=400&height=300&percent=60",
                            "?width=400&height=300&view=frontal",
                            "?width=400&height=300&view=oblique",
                            "?width=400&height=300&view=30,10",
                            "?width=400&height=300&color=force",
                            "?width=400&height=300&color=fiber_length",
                            "?width=400&height=300&color=none",
                            "?width=400&height=300&bones=false",
                            "?width=400&height=300&muscles=false",
                            "?width=400&height=300&legend=false"}) {
    const ClientReply reply = check(std::string("/images/pose.png") + query, pattern);
    const Pixels pixels = decodePng(reply.body);
    EXPECT_EQ(pixels.width, 400);
    EXPECT_EQ(pixels.height, 300);
    EXPECT_GT(pixels.countColors(), 300U) << query;
    EXPECT_TRUE(different.insert(reply.body).second) << query << " changes nothing";
    EXPECT_EQ(
        get(std::string("/images/pose.png") + query, {{"If-None-Match", tagOf(reply)}}).status,
        304);
  }
  EXPECT_EQ(decodePng(get("/images/pose.png").body).width, 1280);
}

TEST_F(ProductViews, StripAndAnimationHaveTheirPosesAndFrames) {
  const ClientReply strip =
      check("/images/strip.png?poses=5&width=200&height=300", "/v1/jobs/{id}/images/strip.png");
  const Pixels pixels = decodePng(strip.body);
  EXPECT_EQ(pixels.width, 1000);
  EXPECT_EQ(pixels.height, 300);
  const ClientReply film =
      check("/images/animation.webp?rate=10&slow_down=2&width=240&height=180&start=0.5&end=1.0",
            "/v1/jobs/{id}/images/animation.webp");
  EXPECT_NEAR(countFrames(film.body), 10, 1) << "half a second at half the speed, ten a second";
}

TEST_F(ProductViews, TooManyPixelsAndBadParametersAreRefused) {
  const auto code = [](const std::string& path) {
    return get(path).json().value("code", "");
  };
  EXPECT_EQ(code("/images/animation.webp?width=4096&height=4096"), "image.size");
  EXPECT_EQ(code("/images/pose.png?width=5"), "request.field");
  EXPECT_EQ(code("/images/pose.png?view=above"), "request.field");
  EXPECT_EQ(get("/images/pose.png?view=above").json()["where"]["field"], "view");
}

TEST_F(ProductViews, ReportHoldsFiguresPosesAndProvenance) {
  const ClientReply report = check("/report.html", "/v1/jobs/{id}/report.html");
  for (const std::string& part : {std::string("<svg"),
                                  std::string("data:image/png;base64,"),
                                  id_,
                                  std::string("markers.trc"),
                                  std::string("Hicks")}) {
    EXPECT_NE(report.body.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(report.body.find("<script"), std::string::npos);
  EXPECT_EQ(get("/report.html", {{"If-None-Match", tagOf(report)}}).status, 304);
  const json quality = check("/quality", "/v1/jobs/{id}/quality").json();
  EXPECT_EQ(quality["verdict"], "pass");
  EXPECT_FALSE(quality["checks"].empty());
}

TEST_F(ProductViews, ValidationFiguresOfTheShippedModelComeInEveryForm) {
  const HttpClient& client = service_->client();
  const std::string folder = "/v1/models/rajagopal2016/validation";
  const json list = client.get(folder).json();
  ASSERT_GT(list["items"].size(), 5U) << list.dump(1);
  for (const json& item : list["items"]) {
    const std::string url = item["url"];
    const ClientReply figure = client.get(url);
    EXPECT_EQ(figure.status, 200) << url << figure.body;
    for (const auto& fault :
         contract().findFaults("GET", "/v1/models/{id}/validation/{name}", figure)) {
      ADD_FAILURE() << url << ": " << fault;
    }
    EXPECT_TRUE(client.get(url + "?data=only").json().contains("panels")) << url;
    EXPECT_EQ(client.get(url + "?format=svg").body.find("<svg"), 0U) << url;
    EXPECT_EQ(client.get(url, {{"If-None-Match", tagOf(figure)}}).status, 304) << url;
  }
}

TEST_F(ProductViews, JobsAreCompared) {
  const json request{{"trial", get("").json()["trial"]},
                     {"settings", {{"stages", {{"last", "id"}}}}}};
  const ClientReply other = service_->client().post("/v1/jobs", request.dump());
  ASSERT_EQ(other.status, 202) << other.body;
  const std::string second = other.json()["id"];
  service_->client().waitForState(second, {"succeeded"});
  const ClientReply reply = service_->client().get("/v1/compare?jobs=" + id_ + "," + second);
  EXPECT_EQ(reply.status, 200) << reply.body;
  for (const auto& fault : contract().findFaults("GET", "/v1/compare", reply)) {
    ADD_FAILURE() << fault;
  }
  const json comparison = reply.json();
  EXPECT_FALSE(comparison["tables"].empty());
  ASSERT_FALSE(comparison["plots"].empty());
  for (const json& plot : comparison["plots"]) {
    const std::string url = plot["url"];
    EXPECT_TRUE(service_->client().get(url).json().contains("$schema")) << url;
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr double kRoom = 12;  // [MiB] of an allocator's own unrest; a kept image has 3.5 unpacked

TEST_F(ProductViews, HundredImagesInARowGrowNeitherTheServiceNorTheChild) {
  const auto draw = [](int first, int last) {
    for (int i = first; i < last; ++i) {
      const std::string percent = std::to_string(0.37 * i);
      ASSERT_EQ(get("/images/pose.png?percent=" + percent).status, 200);
    }
  };
  draw(0, 20);
  const pid_t service = service_->process().pid();
  const pid_t child = findDrawingChild(service);
  ASSERT_GT(child, 0);
  const double service_before = findResidentMemory(service);
  const double child_before = findResidentMemory(child);
  draw(20, 120);
  EXPECT_EQ(findDrawingChild(service), child);
  EXPECT_LT(findResidentMemory(service) - service_before, kRoom);
  EXPECT_LT(findResidentMemory(child) - child_before, kRoom);
  EXPECT_LT(findResidentMemory(child), 300);
}
#endif

TEST_F(ProductViews, ChildKilledDuringARenderIsReplaced) {
  ASSERT_EQ(get("/images/pose.png?percent=1").status, 200);
  const pid_t child = findDrawingChild(service_->process().pid());
  ASSERT_GT(child, 0);
  std::future<ClientReply> film = std::async(std::launch::async, [] {
    return get("/images/animation.webp?width=240&height=180&rate=10");
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  ::kill(child, SIGKILL);
  EXPECT_EQ(film.get().status, 200);
  EXPECT_NE(findDrawingChild(service_->process().pid()), child);
  EXPECT_EQ(get("/images/pose.png?percent=2").status, 200);
}

}  // namespace
}  // namespace gaitmill
