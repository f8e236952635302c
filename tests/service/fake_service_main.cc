// fake_service serve|work …: gaitmill with the fake pipeline; takes the same flags.

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "service/command_line.h"
#include "service/observe/log.h"
#include "service/service.h"
#include "service/solve_command.h"
#include "tests/service/fake_pipeline.h"

namespace gaitmill {
namespace {

int execute(const Command& command) {
  if (const auto* child = std::get_if<ChildOptions>(&command)) {
    return runChild(*child, makeFakePipeline());
  }
  const auto* options = std::get_if<ServeOptions>(&command);
  if (options == nullptr) {
    return EXIT_FAILURE;
  }
  const ServeConfig& config = options->configuration.values;
  setUpLog(config.log_level, config.log_format);
  return options->action == ServeOptions::Action::kWork ? runWork(config, makeFakePipeline())
                                                        : runService(config, makeFakePipeline());
}

}  // namespace
}  // namespace gaitmill

int main(int argc, char** argv) {
  try {
    return gaitmill::execute(
        gaitmill::parseCommandLine(std::vector<std::string>(argv + 1, argv + argc)));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
