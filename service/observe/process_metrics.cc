#include <dirent.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <string>

#include "service/observe/metrics.h"

namespace gaitmill {

namespace {

int countOpenFiles() {
  int count = 0;
  if (DIR* folder = ::opendir("/proc/self/fd")) {
    while (::readdir(folder) != nullptr) {
      ++count;
    }
    ::closedir(folder);
    count -= 3;  // ".", ".." and the folder itself
  }
  return count;
}

struct MemoryUse {
  double resident = 0;  ///< [bytes]
  double address_space = 0;
};

MemoryUse readMemoryUse() {
  std::ifstream file("/proc/self/statm");
  MemoryUse use;
  file >> use.address_space >> use.resident;
  const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
  return {use.resident * page, use.address_space * page};
}

double readProcessorSeconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

void collect(Metrics& metrics) {
  const MemoryUse memory = readMemoryUse();
  metrics.set("process_resident_memory_bytes", {}, memory.resident);
  metrics.set("process_virtual_memory_bytes", {}, memory.address_space);
  metrics.set("process_open_fds", {}, countOpenFiles());
  metrics.set("process_cpu_seconds", {}, readProcessorSeconds());
}

}  // namespace

void addProcessMetrics(Metrics& metrics) {
  metrics.declareGauge("process_resident_memory_bytes", "Resident memory of the service.");
  metrics.declareGauge("process_virtual_memory_bytes", "Address space of the service.");
  metrics.declareGauge("process_open_fds", "Open files of the service.");
  metrics.declareGauge("process_cpu_seconds", "Processor time of the service, without solvers.");
  metrics.declareGauge("process_start_time_seconds", "Start of the service since 1970 UTC.");
  metrics.set("process_start_time_seconds", {}, static_cast<double>(std::time(nullptr)));
  metrics.addCollector(collect);
}

}  // namespace gaitmill
