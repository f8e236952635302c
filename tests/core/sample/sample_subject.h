#pragma once

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/model/model.h"
#include "tests/support/shared_data.h"

namespace gaitmill {

/// Tests on the unscaled generic model, 75.337 kg.
class SampleTest : public SharedDataTest {
 protected:
  Model makeSubject() const {
    const std::string path = shared("data/models/Rajagopal2016.osim");
    return Model(readOsim(readFile(path), path));
  }
};

}  // namespace gaitmill
