#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gaitmill {

/// What a series stands for. Colour and dash follow from it, the same in every figure, so that a
/// reader learns them once.
enum class SeriesRole {
  kPlain,      ///< one of several of equal rank: the n-th gets the n-th colour
  kRight,      ///< right side of the body
  kLeft,       ///< left side
  kReference,  ///< what a curve is held against: inverse dynamics, measured motion
  kSimulated,  ///< what the muscles or the simulation make of it
  kActive,     ///< active part of a muscle's force or moment
  kPassive,    ///< passive part
  kEmg,        ///< measured electromyogram
};

enum class SeriesMark {
  kLine,
  kBand,  ///< between `low` and `y`, drawn behind lines: mean ± SD
  kPoints,
  kBars,  ///< one bar per category
};

/// One curve. NaN interrupts a line.
struct Series {
  std::string name;  ///< in the legend: "inverse dynamics", "Soleus"
  SeriesRole role = SeriesRole::kPlain;
  SeriesMark mark = SeriesMark::kLine;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> low;              ///< of a band, one per x
  std::vector<std::string> categories;  ///< of bars, in place of x
  /// Of overlays: the n-th job, which gets the n-th colour, while the dash stays the role's.
  int group = -1;
};

/// A straight line across a panel: a threshold, toe-off.
struct Guide {
  enum class Direction { kHorizontal, kVertical };
  Direction direction = Direction::kVertical;
  double value = 0;
  std::string label;  ///< "right toe-off", "Hicks et al. 2015"
};

/// A quantity on an axis. Angles of figures are degrees: they are the edge.
struct Axis {
  std::string label;            ///< "Gait cycle", "Knee extension moment"
  std::string unit;             ///< "%", "N·m", "deg"; empty = dimensionless
  std::optional<double> low{};  ///< fixed ends; absent = from the data
  std::optional<double> high{};
};

/// One coordinate system with its curves.
struct Panel {
  std::string name;   ///< unique in the figure: "knee_angle_r"
  std::string title;  ///< "Right knee"
  Axis x;
  Axis y;
  std::vector<Series> series;
  std::vector<Guide> guides;
  std::string note;  ///< under the panel: "RMS 0.35 N·m, peak difference 1.15 N·m"; may be empty
};

/// A picture of data with everything that is needed to draw it, independent of how it is drawn.
struct Figure {
  std::string name;     ///< in the URL: "moments"
  std::string title;    ///< "Joint moments"
  std::string caption;  ///< what is shown, from what, and how; sentences
  int columns = 2;      ///< panels side by side
  std::vector<Panel> panels;
};

/// A figure that can be had, without its data.
struct FigureInfo {
  std::string name;
  std::string title;
  std::string caption;  ///< one sentence on what it shows
};

}  // namespace gaitmill
