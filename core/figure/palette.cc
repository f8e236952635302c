#include "core/figure/palette.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

namespace gaitmill {

namespace {

constexpr const char* kBlack = "#000000";
constexpr const char* kOrange = "#E69F00";
constexpr const char* kSkyBlue = "#56B4E9";
constexpr const char* kGreen = "#009E73";
constexpr const char* kBlue = "#0072B2";
constexpr const char* kVermilion = "#D55E00";
constexpr const char* kPurple = "#CC79A7";
constexpr const char* kGrey = "#767676";  // of contrast 4.5 on white

// Seven series of equal rank look different in colour, 28 in colour and dash. The palette's yellow
// is left out: it is too pale for a line on white.
const std::array<const char*, 7> kPlainColors = {
    kBlue, kOrange, kGreen, kVermilion, kPurple, kSkyBlue, kBlack};
const std::array<std::vector<double>, 4> kPlainDashes = {{{}, {7, 3}, {2, 2}, {8, 3, 2, 3}}};

constexpr std::size_t kLargestSharedLegend = 8;

SeriesStyle makePlainStyle(std::size_t index) {
  return {kPlainColors[index % kPlainColors.size()], kPlainDashes[index % kPlainDashes.size()]};
}

SeriesStyle findRoleStyle(SeriesRole role, std::size_t index) {
  switch (role) {
    case SeriesRole::kPlain:
      return makePlainStyle(index);
    case SeriesRole::kRight:
      return {kBlue, {}};
    case SeriesRole::kLeft:
      return {kVermilion, {6, 3}};
    case SeriesRole::kReference:
      return {kBlack, {}};
    case SeriesRole::kSimulated:
      return {kGreen, {7, 3}};
    case SeriesRole::kActive:
      return {kOrange, {}};
    case SeriesRole::kPassive:
      return {kPurple, {2, 2}};
    case SeriesRole::kEmg:
      return {kGrey, {}};
  }
  return makePlainStyle(index);
}

bool isSame(const LegendEntry& a, const LegendEntry& b) {
  return a.style.color == b.style.color && a.style.dash == b.style.dash && a.mark == b.mark;
}

}  // namespace

std::vector<SeriesStyle> findStyles(const Panel& panel) {
  std::vector<SeriesStyle> styles;
  std::map<std::string, SeriesStyle> known;
  std::size_t plain = 0;
  for (const Series& series : panel.series) {
    const auto [place, is_new] = known.try_emplace(series.name);
    if (is_new) {
      place->second = series.group >= 0
                          ? SeriesStyle{kPlainColors[static_cast<std::size_t>(series.group) %
                                                     kPlainColors.size()],
                                        findRoleStyle(series.role, plain).dash}
                          : findRoleStyle(series.role, plain);
      plain += series.role == SeriesRole::kPlain ? 1 : 0;
    }
    styles.push_back(place->second);
  }
  return styles;
}

std::vector<LegendEntry> makeLegend(const Panel& panel) {
  const std::vector<SeriesStyle> styles = findStyles(panel);
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& series = panel.series[i];
    const auto known = std::find_if(legend.begin(), legend.end(), [&](const LegendEntry& entry) {
      return entry.name == series.name;
    });
    if (known == legend.end()) {
      legend.push_back({series.name, styles[i], series.mark});
    } else if (known->mark == SeriesMark::kBand) {
      known->mark = series.mark;
    }
  }
  return legend;
}

std::vector<LegendEntry> makeSharedLegend(const Figure& figure) {
  std::vector<LegendEntry> shared;
  for (const Panel& panel : figure.panels) {
    for (const LegendEntry& entry : makeLegend(panel)) {
      const auto known = std::find_if(shared.begin(), shared.end(), [&](const LegendEntry& other) {
        return other.name == entry.name;
      });
      // One name with two looks, or two names with one look, would mislead.
      const bool misleads =
          std::any_of(shared.begin(), shared.end(), [&](const LegendEntry& other) {
            return (other.name == entry.name) != isSame(other, entry);
          });
      if (misleads) {
        return {};
      }
      if (known == shared.end()) {
        shared.push_back(entry);
      }
    }
  }
  return shared.size() <= kLargestSharedLegend ? shared : std::vector<LegendEntry>{};
}

}  // namespace gaitmill
