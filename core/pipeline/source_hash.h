#pragma once

namespace gaitmill {

/// SHA-256, hex, over the sources of the core as they were when this binary was built.
extern const char* const kCoreSourceHash;

}  // namespace gaitmill
