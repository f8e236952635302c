#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "service/command_line.h"
#include "service/model_command.h"
#include "service/models_folder.h"
#include "service/observe/log.h"
#include "service/product_drawing.h"
#include "service/product_pipeline.h"
#include "service/run_command.h"
#include "service/sample_command.h"
#include "service/service.h"
#include "service/version.h"

namespace gaitmill {
namespace {

int execute(ServeOptions options) {
  if (options.action == ServeOptions::Action::kPrintConfig) {
    std::cout << printConfiguration(options.configuration) << '\n';
    return kExitSuccess;
  }
  ServeConfig config = options.configuration.values;
  setUpLog(config.log_level, config.log_format);
  config.models = findModelsFolder(config.models);
  const PipelineFunctions functions = makeProductPipeline(config.models);
  return options.action == ServeOptions::Action::kWork ? runWork(config, functions)
                                                       : runService(config, functions);
}

int execute(const ChildOptions& options) {
  return runChild(options, makeProductPipeline(options.models));
}

int execute(const BackupOptions& options) {
  backUp(options, std::cout);
  return kExitSuccess;
}

int execute(const RestoreOptions& options) {
  restore(options, std::cout);
  return kExitSuccess;
}

int execute(const KeysOptions& options) {
  manageKeys(options, std::cout);
  return kExitSuccess;
}

int execute(RunOptions options) {
  options.models = findModelsFolder(options.models);
  runOnFiles(options, makeProductPipeline(options.models), std::cout, std::cerr);
  return kExitSuccess;
}

std::string findModel(const std::string& path, const std::string& models) {
  return path.empty() ? findModelsFolder(models) + "/rajagopal2016/rajagopal2016.osim" : path;
}

int execute(const ModelOptions& options) {
  std::cout << describeModel(findModel(options.path, options.models), options.report);
  return kExitSuccess;
}

int execute(CalibrateOptions options) {
  options.path = findModel(options.path, options.models);
  std::cout << calibrateModel(options);
  return kExitSuccess;
}

int execute(const ValidateModelOptions& options) {
  std::cout << describeValidation(options);
  return kExitSuccess;
}

int execute(const RenderOptions& options) {
  renderFiles(options, makeProductDrawing(options.geometry), std::cout);
  return kExitSuccess;
}

int execute(const SampleOptionsOnDisk& options) {
  writeSample(options, std::cout);
  return kExitSuccess;
}

int execute(const VersionOptions&) {
  std::cout << "gaitmill " << kVersion << '\n';
  return kExitSuccess;
}

int execute(const PrintAndExit& message) {
  (message.exit_code == kExitSuccess ? std::cout : std::cerr) << message.text;
  return message.exit_code;
}

int findExitCode(const Error& error) {
  switch (error.code()) {
    case ErrorCode::kUsage:
    case ErrorCode::kConfig:
      return kExitUsage;
    case ErrorCode::kInternal:
    case ErrorCode::kStorage:
      return kExitInternal;
    default:
      return kExitFailed;
  }
}

int runMain(const std::vector<std::string>& arguments) {
  try {
    return std::visit([](const auto& command) { return execute(command); },
                      parseCommandLine(arguments));
  } catch (const Error& error) {
    std::cerr << "gaitmill: " << error.what() << '\n';
    return findExitCode(error);
  } catch (const std::exception& error) {
    std::cerr << "gaitmill: " << error.what() << '\n';
    return kExitInternal;
  }
}

}  // namespace
}  // namespace gaitmill

int main(int argc, char** argv) {
  return gaitmill::runMain({argv + 1, argv + argc});
}
