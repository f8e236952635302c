#include "core/io/c3d_layout.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

// Bytes of the header (spec: words of two bytes, counted from 0 here).
constexpr std::size_t kPointCount = 2;
constexpr std::size_t kSamplesPerFrame = 4;
constexpr std::size_t kFirstFrame = 6;
constexpr std::size_t kLastFrame = 8;
constexpr std::size_t kScale = 12;
constexpr std::size_t kDataBlock = 16;
constexpr std::size_t kSubframes = 18;
constexpr std::size_t kRate = 20;

constexpr double kSlowestRate = 1e-3;  // [Hz]
constexpr double kFastestRate = 1e6;   // [Hz]
constexpr long kSaturatedCount = 65535;

/// A number of frames that some part of the file states.
struct FrameCount {
  const char* source;
  long first;
  long count;
  bool is_saturated = false;  // the word is full: that many or more
};

class LayoutFinder {
 public:
  LayoutFinder(const C3dBytes& file,
               const C3dParameters& parameters,
               const std::string& file_name,
               std::vector<std::string>& warnings)
      : file_(file), parameters_(parameters), file_name_(file_name), warnings_(warnings) {}

  C3dLayout find() {
    findRate();
    const std::vector<C3dLayout> layouts = {makeParameterLayout(), makeHeaderLayout()};
    const std::vector<FrameCount> counts = listFrameCounts();
    C3dLayout layout = choose(layouts, counts);
    require(layout.storage == C3dStorage::kReal ||
                (layout.point_scale > 0 && std::isfinite(layout.point_scale)) ||
                layout.point_count == 0,
            ErrorCode::kC3dHeader,
            "the scale of the points is " + formatNumber(layout.point_scale),
            {file_name_, 0, 0, "POINT:SCALE"});
    return layout;
  }

 private:
  void findRate();
  C3dLayout makeParameterLayout() const;
  C3dLayout makeHeaderLayout() const;
  int findSubframes() const;
  std::vector<FrameCount> listFrameCounts() const;
  std::size_t findRoom(const C3dLayout& layout) const;
  C3dLayout choose(const std::vector<C3dLayout>& layouts, const std::vector<FrameCount>& counts);
  void dropPadding(C3dLayout& layout) const;
  void warnOfDifferences(const std::vector<C3dLayout>& layouts,
                         const std::vector<FrameCount>& counts,
                         const C3dLayout& chosen);

  const C3dBytes& file_;
  const C3dParameters& parameters_;
  const std::string& file_name_;
  std::vector<std::string>& warnings_;
  double rate_ = 0;
};

bool isRate(std::optional<double> rate) {
  return rate && *rate >= kSlowestRate && *rate <= kFastestRate;
}

void LayoutFinder::findRate() {
  const std::optional<double> stated = parameters_.findNumber("POINT", "RATE");
  const double header = static_cast<double>(file_.real(kRate));
  require(isRate(stated) || isRate(header),
          ErrorCode::kC3dHeader,
          "neither POINT:RATE nor the header states a frame rate",
          {file_name_, 0, 0, "POINT:RATE"});
  rate_ = isRate(stated) ? *stated : header;
  if (isRate(stated) && std::abs(header - *stated) > 1e-3 * *stated) {
    warnings_.push_back("the header states " + formatNumber(header) + " Hz, POINT:RATE " +
                        formatNumber(*stated) + " Hz, which was taken");
  }
}

void setScale(C3dLayout& layout, double scale) {
  layout.storage = scale < 0 ? C3dStorage::kReal : C3dStorage::kInteger;
  layout.point_scale = std::abs(scale);
}

C3dLayout LayoutFinder::makeHeaderLayout() const {
  C3dLayout layout;
  layout.rate = rate_;
  layout.data_begin = kC3dBlock * (std::max<std::size_t>(file_.word(kDataBlock), 1) - 1);
  layout.point_count = file_.word(kPointCount);
  const int samples = file_.word(kSamplesPerFrame);
  layout.subframe_count = std::max<int>(file_.word(kSubframes), 1);
  layout.channel_count = samples / layout.subframe_count;
  setScale(layout, static_cast<double>(file_.real(kScale)));
  return layout;
}

int LayoutFinder::findSubframes() const {
  const double ratio = parameters_.findNumber("ANALOG", "RATE").value_or(0) / rate_;
  if (ratio >= 0.5 && ratio < kSaturatedCount) {
    return static_cast<int>(std::lround(ratio));
  }
  return std::max<int>(file_.word(kSubframes), 1);
}

C3dLayout LayoutFinder::makeParameterLayout() const {
  C3dLayout layout = makeHeaderLayout();
  if (const auto used = parameters_.findNumber("POINT", "USED"); used && *used >= 0) {
    layout.point_count = static_cast<int>(std::min(*used, 65535.0));
  }
  if (const auto used = parameters_.findNumber("ANALOG", "USED"); used && *used >= 0) {
    layout.channel_count = static_cast<int>(std::min(*used, 65535.0));
    layout.subframe_count = findSubframes();
  }
  if (const auto scale = parameters_.findNumber("POINT", "SCALE"); scale && *scale != 0) {
    setScale(layout, *scale);
  }
  const auto start = parameters_.findNumber("POINT", "DATA_START");
  if (layout.data_begin == 0 && start && *start >= 2 && *start <= 65535.0) {
    layout.data_begin = kC3dBlock * (static_cast<std::size_t>(*start) - 1);
  }
  return layout;
}

// In the order of trust: the later ones saturate, or were forgotten when the trial was cut.
std::vector<FrameCount> LayoutFinder::listFrameCounts() const {
  std::vector<FrameCount> counts;
  const std::vector<double> start = parameters_.findNumbers("TRIAL", "ACTUAL_START_FIELD");
  const std::vector<double> end = parameters_.findNumbers("TRIAL", "ACTUAL_END_FIELD");
  if (start.size() >= 2 && end.size() >= 2) {
    // Low word, high word.
    const double first = start[0] + 65536.0 * start[1];
    const double last = end[0] + 65536.0 * end[1];
    if (first >= 1 && last >= first && last < 1e9) {
      counts.push_back({"TRIAL", std::lround(first), std::lround(last - first) + 1});
    }
  }
  const long first = file_.word(kFirstFrame);
  const long last = file_.word(kLastFrame);
  const auto long_frames = parameters_.findNumber("POINT", "LONG_FRAMES");
  if (long_frames && *long_frames >= 1 && *long_frames < 1e9) {
    counts.push_back({"POINT:LONG_FRAMES", first, std::lround(*long_frames)});
  }
  if (last >= first && last > 0) {
    counts.push_back({"the header", first, last - first + 1, last == kSaturatedCount});
  }
  const auto frames = parameters_.findNumber("POINT", "FRAMES");
  if (frames && *frames >= 1 && *frames < 1e9) {
    counts.push_back({"POINT:FRAMES", first, std::lround(*frames), *frames == kSaturatedCount});
  }
  return counts;
}

std::size_t LayoutFinder::findRoom(const C3dLayout& layout) const {
  const std::size_t size = file_.all().size();
  const bool has_data = layout.data_begin >= kC3dBlock && layout.data_begin < size;
  return has_data && layout.frameSize() > 0 ? (size - layout.data_begin) / layout.frameSize() : 0;
}

C3dLayout LayoutFinder::choose(const std::vector<C3dLayout>& layouts,
                               const std::vector<FrameCount>& counts) {
  struct Choice {
    C3dLayout layout;
    int rank = 0;  // 0 nothing to read, 1 cut off, 2 fits with much left over, 3 fits to a block
  };
  Choice best;
  for (const C3dLayout& layout : layouts) {
    const auto room = static_cast<long>(findRoom(layout));
    for (const FrameCount& stated : counts) {
      const bool fits = stated.count <= room;
      const long count = fits && !stated.is_saturated ? stated.count : room;
      const std::size_t left = file_.all().size() -
                               std::min(file_.all().size(), layout.data_begin) -
                               layout.frameSize() * static_cast<std::size_t>(count);
      const bool to_a_block = fits && left < kC3dBlock + layout.frameSize();
      const int rank = room == 0 ? 0 : to_a_block ? 3 : fits ? 2 : 1;
      if (rank > best.rank) {
        best = {layout, rank};
        best.layout.first_frame = std::max(stated.first, 1L);
        best.layout.frame_count = static_cast<int>(std::min(count, 2000000000L));
      }
    }
  }
  if (best.rank == 0) {
    const bool empty = layouts[0].frameSize() == 0 && layouts[1].frameSize() == 0;
    throw Error(ErrorCode::kC3dData,
                empty            ? "the file states neither points nor analog channels"
                : counts.empty() ? "the file states no frames"
                                 : "the file ends before its first frame is complete",
                {file_name_, 0, 0, empty ? "POINT:USED" : ""});
  }
  if (best.layout.frame_count == static_cast<int>(findRoom(best.layout))) {
    dropPadding(best.layout);
  }
  warnOfDifferences(layouts, counts, best.layout);
  return best.layout;
}

// Where no count says how many frames there are, zeros that fill the last block look like some.
void LayoutFinder::dropPadding(C3dLayout& layout) const {
  const std::string_view bytes = file_.all();
  const std::size_t used = bytes.find_last_not_of('\0') + 1;  // npos + 1 = 0
  const std::size_t frames = layout.frameSize();
  const std::size_t room = used <= layout.data_begin ? 0 : used - layout.data_begin;
  const auto with_data = static_cast<int>((room + frames - 1) / frames);
  const auto padding = static_cast<int>((kC3dBlock - 1) / frames);
  layout.frame_count =
      std::max({1, layout.frame_count - padding, std::min(layout.frame_count, with_data)});
}

void LayoutFinder::warnOfDifferences(const std::vector<C3dLayout>& layouts,
                                     const std::vector<FrameCount>& counts,
                                     const C3dLayout& chosen) {
  const auto warnOfCount = [&](const char* what, int parameters, int header, int taken) {
    if (parameters != header) {
      warnings_.push_back("the header states " + std::to_string(header) + ' ' + what +
                          ", the parameters " + std::to_string(parameters) + "; " +
                          std::to_string(taken) + " were taken");
    }
  };
  warnOfCount("points", layouts[0].point_count, layouts[1].point_count, chosen.point_count);
  if (chosen.channel_count > 0) {
    warnOfCount("analog channels",
                layouts[0].channel_count,
                layouts[1].channel_count,
                chosen.channel_count);
    warnOfCount("analog samples per frame and channel",
                layouts[0].subframe_count,
                layouts[1].subframe_count,
                chosen.subframe_count);
  }
  if (layouts[0].storage != layouts[1].storage) {
    warnings_.push_back(std::string("header and POINT:SCALE disagree on how numbers are stored; "
                                    "they were read as ") +
                        (chosen.storage == C3dStorage::kReal ? "reals" : "integers"));
  }
  for (const FrameCount& stated : counts) {
    if (stated.count != chosen.frame_count) {
      warnings_.push_back(std::string(stated.source) + " states " + std::to_string(stated.count) +
                          " frames, " + std::to_string(chosen.frame_count) + " were read");
    }
  }
}

}  // namespace

C3dLayout findC3dLayout(const C3dBytes& file,
                        const C3dParameters& parameters,
                        const std::string& file_name,
                        std::vector<std::string>& warnings) {
  return LayoutFinder(file, parameters, file_name, warnings).find();
}

}  // namespace gaitmill
