// fake_service DATABASE MODELS [WORKERS]: the service on a free port with the fake pipeline.

#include <cstdlib>
#include <exception>
#include <iostream>

#include "service/observe/log.h"
#include "service/service.h"
#include "tests/service/fake_pipeline.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    return EXIT_FAILURE;
  }
  gaitmill::ServeConfig config;
  config.database = argv[1];
  config.models = argv[2];
  config.port = 0;
  config.workers = argc > 3 ? std::atoi(argv[3]) : 1;
  config.stop_limit = std::chrono::milliseconds(1000);
  try {
    gaitmill::setUpLog("error");
    return gaitmill::runService(config, gaitmill::makeFakePipeline());
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
