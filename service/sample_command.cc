#include "service/sample_command.h"

#include <map>
#include <string>
#include <utility>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/pipeline/sample_files.h"
#include "service/models_folder.h"

namespace gaitmill {

void writeSample(const SampleOptionsOnDisk& options, std::ostream& out) {
  const std::string path = findModelsFolder(options.models) + "/rajagopal2016/rajagopal2016.osim";
  SampleFiles sample = makeSampleFiles(readOsim(readFile(path), path));
  std::map<std::string, std::string> files = std::move(sample.recorded);
  if (options.content == SampleOptionsOnDisk::Content::kWithTruth) {
    files.merge(sample.truth);
  }
  for (const auto& [name, bytes] : files) {
    writeFile(options.out + "/" + name, bytes);
    out << options.out << "/" << name << '\n';
  }
}

}  // namespace gaitmill
