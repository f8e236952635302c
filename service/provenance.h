#pragma once

#include <map>
#include <string>

namespace gaitmill {

/// Everything that a job's numbers depend on. Nothing of the machine, the time, the number of
/// threads or the names that people give is here, so equal work has equal provenance anywhere.
struct Provenance {
  std::map<std::string, std::string> inputs;  ///< SHA-256, hex, of the bytes by part name
  double mass = 0;                            ///< [kg] of the subject
  double height = 0;                          ///< [m]
  std::string model;                          ///< SHA-256, hex, of the generic model's document
  std::string marker_set;                     ///< SHA-256, hex, of the marker set's document
  std::string settings_json;  ///< the whole document; the order of its fields does not matter
  std::string code;           ///< sourceVersion()
};

/// The same as canonical JSON: fields in alphabetical order, no blanks, shortest exact numbers.
/// @throws Error kInternal if the settings are not JSON
std::string renderProvenance(const Provenance& provenance);

/// SHA-256 of renderProvenance(), hex.
std::string calcProvenance(const Provenance& provenance);

/// "gaitmill 0.1.0 " and the first 16 hex digits of the SHA-256 over the sources of the core, fixed
/// when the binary is built: two builds of the same sources say the same.
const std::string& sourceVersion();

}  // namespace gaitmill
