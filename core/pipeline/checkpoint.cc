#include "core/pipeline/checkpoint.h"

#include <cstddef>
#include <string_view>

#include "core/base/error.h"
#include "core/pipeline/archive.h"
#include "core/pipeline/checkpoint_fields.h"

namespace gaitmill {

namespace {

/// Changes whenever the meaning of the bytes behind it does.
constexpr std::string_view kMagic = "gaitmill checkpoint 1\n";
constexpr std::size_t kChecksumBytes = 8;

/// To whom a checkpoint belongs.
struct Label {
  std::string version;
  std::uint64_t fingerprint = 0;
  Stage stage = Stage::kScale;
};

template <class Archive>
void visitFields(Archive& archive, Access<Archive, Label>& value) {
  auto& [version, fingerprint, stage] = value;
  archive(version, fingerprint, stage);
}

template <class Archive>
void visitResult(Archive& archive, Stage stage, Access<Archive, Job>& job) {
  switch (stage) {
    case Stage::kScale:
      return archive(job.scale);
    case Stage::kIk:
      return archive(job.ik);
    case Stage::kRra:
      return archive(job.rra);
    case Stage::kId:
      return archive(job.id);
    case Stage::kSo:
      return archive(job.so);
    case Stage::kCmc:
      return archive(job.cmc);
  }
}

void requireUsable(bool ok, const std::string& message) {
  require(ok, ErrorCode::kCheckpointUnusable, message);
}

/// The bytes between the frame's head and its end, checked against the sum in the head.
std::string_view unwrap(const std::string& bytes) {
  const std::size_t head = kMagic.size() + kChecksumBytes;
  requireUsable(bytes.size() >= head && bytes.compare(0, kMagic.size(), kMagic) == 0,
                "these bytes are no checkpoint of this version of gaitmill");
  const std::string_view all(bytes);
  std::uint64_t sum = 0;
  ArchiveReader(all.substr(kMagic.size(), kChecksumBytes))(sum);
  const std::string_view content = all.substr(head);
  requireUsable(calcChecksum(content) == sum, "the bytes of a checkpoint are damaged");
  return content;
}

std::string wrap(const std::string& content) {
  ArchiveWriter sum;
  sum(calcChecksum(content));
  return std::string(kMagic) + sum.bytes() + content;
}

bool hasResult(Stage stage, const Job& job) {
  switch (stage) {
    case Stage::kScale:
      return job.scale.has_value();
    case Stage::kIk:
      return job.ik.has_value();
    case Stage::kRra:
      return job.rra.has_value() && !job.rra->passes.empty();
    case Stage::kId:
      return job.id.has_value();
    case Stage::kSo:
      return job.so.has_value();
    case Stage::kCmc:
      return job.cmc.has_value();
  }
  return false;
}

}  // namespace

std::uint64_t calcFingerprint(const TrialInput& input, const InputFile& settings) {
  ArchiveWriter numbers;
  numbers(input.mass, input.height);
  std::uint64_t sum = calcChecksum(numbers.bytes());
  const auto add = [&sum](const std::string& text) {
    ArchiveWriter length;
    length(std::uint64_t{text.size()});
    sum = calcChecksum(text, calcChecksum(length.bytes(), sum));
  };
  add(settings.bytes);
  for (const std::optional<InputFile>* file : {&input.static_markers,
                                               &input.static_markers_2,
                                               &input.markers,
                                               &input.ground_reaction,
                                               &input.emg,
                                               &input.model,
                                               &input.coordinates,
                                               &input.marker_set,
                                               &input.marker_names}) {
    add(file->has_value() ? (*file)->name : std::string());
    add(file->has_value() ? (*file)->bytes : std::string());
  }
  return sum;
}

std::string writeCheckpoint(Stage stage, std::size_t first_warning, const Job& job) {
  const auto from = job.warnings.begin() + static_cast<std::ptrdiff_t>(first_warning);
  const std::vector<std::string> warnings(from, job.warnings.end());
  ArchiveWriter archive;
  archive(Label{codeVersion(), job.fingerprint, stage},
          job.seconds[static_cast<std::size_t>(stage)],
          warnings);
  visitResult(archive, stage, job);
  return wrap(archive.bytes());
}

void readCheckpoint(Stage stage, const std::string& bytes, Job& job) {
  ArchiveReader archive(unwrap(bytes));
  Label label;
  archive(label);
  requireUsable(label.version == codeVersion(),
                "a checkpoint was written by version " + label.version + " of the code, this is " +
                    codeVersion());
  requireUsable(label.fingerprint == job.fingerprint,
                "a checkpoint belongs to other input or other settings");
  requireUsable(label.stage == stage,
                std::string("expected the checkpoint of stage ") + stageName(stage));
  std::vector<std::string> warnings;
  archive(job.seconds[static_cast<std::size_t>(stage)], warnings);
  visitResult(archive, stage, job);
  archive.finish();
  requireUsable(hasResult(stage, job), "a checkpoint has no result in it");
  job.warnings.insert(job.warnings.end(), warnings.begin(), warnings.end());
}

}  // namespace gaitmill
