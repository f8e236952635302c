// Figures of joint moments and powers.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/figure/coordinate_names.h"
#include "core/figure/job_builders.h"

namespace gaitmill {

namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string capitalize(std::string word) {
  if (!word.empty() && word.front() >= 'a' && word.front() <= 'z') {
    word.front() = static_cast<char>(word.front() - 'a' + 'A');
  }
  return word;
}

/// Names of the coordinates that have a column with this suffix and do not belong to the pelvis,
/// whose moments are residuals, by their name without side.
std::vector<SidedColumns> findCoordinates(const TimeSeries& table, const std::string& suffix) {
  std::vector<std::string> coordinates;
  for (const std::string& label : table.labels) {
    const std::string name = label.substr(0, label.size() - std::min(label.size(), suffix.size()));
    const bool is_other = endsWith(name, "_muscle") || endsWith(name, "_active") ||
                          endsWith(name, "_passive") || endsWith(name, "_beta");
    if (endsWith(label, suffix) && !is_other && name.rfind("pelvis_", 0) != 0) {
      coordinates.push_back(name);
    }
  }
  return pairSides(coordinates);
}

const Series* findLine(const Panel& panel, SeriesRole role) {
  const auto found =
      std::find_if(panel.series.begin(), panel.series.end(), [&](const Series& series) {
        return series.role == role && series.mark == SeriesMark::kLine;
      });
  return found == panel.series.end() ? nullptr : &*found;
}

/// "RMS difference 0.24 N·m, largest 0.65 N·m (1.1 % of the peak moment)"
std::string describeDifference(const Panel& panel) {
  const Series* reference = findLine(panel, SeriesRole::kReference);
  const Series* muscles = findLine(panel, SeriesRole::kSimulated);
  if (reference == nullptr || muscles == nullptr) {
    return "";
  }
  double squares = 0;
  double largest = 0;
  double peak = 0;
  int count = 0;
  for (std::size_t i = 0; i < std::min(reference->y.size(), muscles->y.size()); ++i) {
    const double difference = reference->y[i] - muscles->y[i];
    if (std::isfinite(difference)) {
      squares += difference * difference;
      largest = std::max(largest, std::abs(difference));
      peak = std::max(peak, std::abs(reference->y[i]));
      ++count;
    }
  }
  if (count == 0) {
    return "";
  }
  const std::string& unit = panel.y.unit;
  return "RMS difference " + formatShort(std::sqrt(squares / count)) + " " + unit + ", largest " +
         formatShort(largest) + " " + unit + " (" + formatFixed(100 * largest / peak, 1) +
         " % of the peak)";
}

/// Inverse dynamics against the muscles at one joint of one leg.
Panel makeComparisonPanel(const JobData& data,
                          const std::string& coordinate,
                          Side side,
                          const std::string& title,
                          double sign) {
  const TimeSeries& moments = data.table("moments");
  Panel panel = makePanel(data, coordinate, title, {"Moment", "N·m"});
  data.addCurve(moments,
                coordinate + "_moment",
                side,
                {"inverse dynamics", SeriesRole::kReference, sign},
                panel);
  data.addCurve(moments,
                coordinate + "_muscle_moment",
                side,
                {"muscles", SeriesRole::kSimulated, sign},
                panel);
  data.addToeOffs(side != Side::kLeft, side == Side::kLeft, panel);
  panel.note = describeDifference(panel);
  return panel;
}

/// Total, active and passive moment of the muscles at one joint of one leg.
Panel makePartsPanel(const JobData& data,
                     const std::string& coordinate,
                     Side side,
                     const std::string& title,
                     double sign) {
  const TimeSeries& table = data.table("muscle_moments");
  Panel panel = makePanel(data, coordinate, title, {"Moment", "N·m"});
  data.addCurve(
      table, coordinate + "_muscle_moment", side, {"total", SeriesRole::kSimulated, sign}, panel);
  data.addCurve(
      table, coordinate + "_active_moment", side, {"active", SeriesRole::kActive, sign}, panel);
  data.addCurve(
      table, coordinate + "_passive_moment", side, {"passive", SeriesRole::kPassive, sign}, panel);
  data.addToeOffs(side != Side::kLeft, side == Side::kLeft, panel);
  return panel;
}

struct SideColumn {
  Side side;
  const std::string& coordinate;
};

std::vector<SideColumn> listSides(const SidedColumns& pair) {
  std::vector<SideColumn> sides;
  for (const SideColumn& one : {SideColumn{Side::kRight, pair.right},
                                SideColumn{Side::kLeft, pair.left},
                                SideColumn{Side::kNone, pair.center}}) {
    if (!one.coordinate.empty()) {
      sides.push_back(one);
    }
  }
  return sides;
}

/// "Right hip flexion"
std::string makeTitle(const std::string& base, Side side) {
  std::string display = findCoordinateName(base).display;
  if (side == Side::kNone) {
    return display;
  }
  display.front() = static_cast<char>(display.front() - 'A' + 'a');
  return capitalize(sideWord(side)) + " " + display;
}

/// The paper's three joints and its signs.
struct PaperJoint {
  const char* coordinate;
  const char* title;
  double sign;
};
constexpr PaperJoint kPaperJoints[] = {{"hip_flexion_r", "Hip flexion", 1},
                                       {"knee_angle_r", "Knee extension", -1},
                                       {"ankle_angle_r", "Ankle plantarflexion", -1}};

}  // namespace

void buildMoments(const JobData& data, Figure& figure) {
  const TimeSeries& moments = data.table("moments");
  const auto hasMuscles = [&](const std::string& coordinate) {
    return moments.findColumn(coordinate + "_muscle_moment").has_value();
  };
  for (const SidedColumns& pair : findCoordinates(moments, "_moment")) {
    const std::vector<SideColumn> sides = listSides(pair);
    if (hasMuscles(sides.front().coordinate)) {
      for (const SideColumn& one : sides) {
        figure.panels.push_back(
            makeComparisonPanel(data, one.coordinate, one.side, makeTitle(pair.base, one.side), 1));
      }
    }
  }
  for (const SidedColumns& pair : findCoordinates(moments, "_moment")) {
    if (!hasMuscles(listSides(pair).front().coordinate)) {
      Panel panel =
          makePanel(data, pair.base, findCoordinateName(pair.base).display, {"Moment", "N·m"});
      const auto suffixed = [](const std::string& name) {
        return name.empty() ? name : name + "_moment";
      };
      data.addSides(moments,
                    {pair.base, suffixed(pair.right), suffixed(pair.left), suffixed(pair.center)},
                    1,
                    panel);
      data.addToeOffs(panel);
      figure.panels.push_back(std::move(panel));
    }
  }
  figure.caption += " Positive in the direction that is named. " + data.describeAxis();
}

void buildMomentParts(const JobData& data, Figure& figure) {
  for (const SidedColumns& pair : findCoordinates(data.table("muscle_moments"), "_muscle_moment")) {
    for (const SideColumn& one : listSides(pair)) {
      figure.panels.push_back(
          makePartsPanel(data, one.coordinate, one.side, makeTitle(pair.base, one.side), 1));
    }
  }
  figure.caption += " Positive in the direction that is named. " + data.describeAxis();
}

void buildJointPowers(const JobData& data, Figure& figure) {
  const TimeSeries& powers = data.table("joint_powers");
  for (const SidedColumns& pair : findCoordinates(powers, "_power")) {
    const auto suffixed = [](const std::string& name) {
      return name.empty() ? name : name + "_power";
    };
    const std::string any = suffixed(listSides(pair).front().coordinate);
    if (powers.values.col(powers.getColumn(any)).isZero(1e-9)) {
      continue;
    }
    Panel panel = makePanel(data, pair.base, findCoordinateName(pair.base).display, {"Power", "W"});
    data.addSides(powers,
                  {pair.base, suffixed(pair.right), suffixed(pair.left), suffixed(pair.center)},
                  1,
                  panel);
    data.addToeOffs(panel);
    figure.panels.push_back(std::move(panel));
  }
  figure.caption += " " + data.describeAxis();
}

void buildPaperFigure4(const JobData& data, Figure& figure) {
  for (const PaperJoint& joint : kPaperJoints) {
    figure.panels.push_back(
        makeComparisonPanel(data, joint.coordinate, Side::kRight, joint.title, joint.sign));
  }
  figure.caption += " " + data.describeAxis(false);
}

void buildPaperSupplementalFigure4(const JobData& data, Figure& figure) {
  for (const PaperJoint& joint : kPaperJoints) {
    figure.panels.push_back(
        makePartsPanel(data, joint.coordinate, Side::kRight, joint.title, joint.sign));
  }
  figure.caption += " " + data.describeAxis(false);
}

}  // namespace gaitmill
