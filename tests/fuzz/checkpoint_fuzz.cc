#include <string>

#include "core/pipeline/archive.h"
#include "core/pipeline/checkpoint_fields.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {
namespace {

template <class Result>
void readResult(std::string_view bytes) {
  ArchiveReader archive(bytes);
  Result result;
  archive(result);
  archive.finish();
  ArchiveWriter again;
  again(result);
  requirePromise(again.bytes().size() == bytes.size(), "what was read takes as many bytes again");
}

}  // namespace

// The content of a checkpoint, behind its checksum.
GAITMILL_FUZZ_TARGET(checkpoint) {
  tryParse([&] { readResult<ScaleResult>(input); });
  tryParse([&] { readResult<IkResult>(input); });
  tryParse([&] { readResult<RraResult>(input); });
  tryParse([&] { readResult<IdResult>(input); });
  tryParse([&] { readResult<SoResult>(input); });
  tryParse([&] { readResult<CmcResult>(input); });
}

}  // namespace gaitmill
