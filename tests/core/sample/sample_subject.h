#pragma once

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/model/model.h"

namespace gaitmill {

/// Tests on the project's unscaled model, 75.337 kg.
class SampleTest : public ::testing::Test {
 protected:
  Model makeSubject() const {
    const std::string path = "models/rajagopal2016/rajagopal2016.osim";
    return Model(readOsim(readFile(path), path));
  }
};

}  // namespace gaitmill
