#include "service/sample_command.h"

#include <map>
#include <string>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/pipeline/sample_files.h"
#include "service/models_folder.h"

namespace gaitmill {

namespace {

using Files = std::map<std::string, std::string>;

constexpr const char* kRecorded[] = {
    "static.trc", "markers.trc", "grf.mot", "emg.sto", "trial.json"};

Files readRecorded(const std::string& models) {
  Files files;
  for (const char* name : kRecorded) {
    files[name] = readFile(models + "/sample/" + name);
  }
  return files;
}

Files generateWithTruth(const std::string& models) {
  const std::string name = "rajagopal2016.osim";
  SampleFiles sample = makeSampleFiles(readOsim(readFile(models + "/rajagopal2016/" + name), name));
  sample.recorded.merge(sample.truth);
  return sample.recorded;
}

}  // namespace

void writeSample(const SampleOptionsOnDisk& options, std::ostream& out) {
  const std::string models = findModelsFolder(options.models);
  const Files files = options.content == SampleOptionsOnDisk::Content::kWithTruth
                          ? generateWithTruth(models)
                          : readRecorded(models);
  for (const auto& [name, bytes] : files) {
    writeFile(options.out + "/" + name, bytes);
    out << options.out << "/" << name << '\n';
  }
}

}  // namespace gaitmill
