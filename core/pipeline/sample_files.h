#pragma once

#include <map>
#include <string>

#include "core/data/model_spec.h"
#include "core/sample/sample_person.h"
#include "core/sample/sample_trial.h"

namespace gaitmill {

/// The sample trial as files, by name.
struct SampleFiles {
  /// What a laboratory would hand over, and what models/sample holds: static.trc, markers.trc,
  /// grf.mot, emg.sto, trial.json (the upload's part "trial"). Lengths to 0.01 mm, forces to 0.1
  /// mN.
  std::map<std::string, std::string> recorded;
  /// What was put in: subject.osim, coordinates.mot (degrees), moments.sto.
  std::map<std::string, std::string> truth;
};

/// The true subject: the generic model stretched by the person's factors, with the person's mass.
ModelSpec makeSampleSubject(const ModelSpec& generic, const SamplePerson& person = {});

/// Generates the trial on the true subject and writes it.
/// @param generic  Rajagopal2016, unscaled
/// @throws Error kModelReference, kInputCoordinates if it is another model
SampleFiles makeSampleFiles(const ModelSpec& generic,
                            const SamplePerson& person = {},
                            const SampleOptions& options = {});

}  // namespace gaitmill
