#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/figure/svg.h"
#include "core/report/report_parts.h"

namespace gaitmill {

namespace {

// As wide as a page of paper is at the size of its words, so that a chart's words are readable
// there.
constexpr double kChartWidth = 800;  // [px]

// These say what the body does, not how far to trust it, or stand in the report's tables already;
// most have a panel per muscle.
constexpr const char* kLeftOut[] = {"muscle_forces",
                                    "fiber_lengths",
                                    "fiber_velocities",
                                    "muscle_powers",
                                    "muscle_work",
                                    "joint_powers",
                                    "tracking_errors"};

bool isLeftOut(const Figure& figure) {
  return std::find(std::begin(kLeftOut), std::end(kLeftOut), figure.name) != std::end(kLeftOut);
}

/// Rows of panels in one piece: few enough that pieces fill pages well.
int findRowsPerPiece(const Figure& figure) {
  return figure.columns <= 1 ? 2 : figure.columns <= 3 ? 3 : 4;
}

int divideRoundingUp(int number, int by) {
  return (number + by - 1) / by;
}

/// The figure in pieces of whole rows, about equally many each: paper cannot break a drawing.
std::vector<Figure> splitForPaper(const Figure& figure) {
  const int columns = std::max(1, figure.columns);
  const int count = static_cast<int>(figure.panels.size());
  const int rows = divideRoundingUp(count, columns);
  const int pieces = std::max(1, divideRoundingUp(rows, findRowsPerPiece(figure)));
  const int panels = divideRoundingUp(rows, pieces) * columns;
  std::vector<Figure> split;
  for (int first = 0; first < count; first += panels) {
    Figure piece = figure;
    piece.panels.assign(figure.panels.begin() + first,
                        figure.panels.begin() + std::min(first + panels, count));
    split.push_back(std::move(piece));
  }
  return split;
}

/// On a phone a chart keeps a legible size and scrolls by itself.
Html renderChart(const Figure& figure) {
  SvgOptions options;
  options.width = kChartWidth;
  // The first piece stays with the words above it.
  Html words = element("h3", figure.title) + element("p", figure.caption);
  Html chart;
  for (const Figure& piece : splitForPaper(figure)) {
    const Html drawing = element(
        "div",
        {{"class", "wide"}, {"role", "region"}, {"tabindex", "0"}, {"aria-label", figure.title}},
        trusted(renderSvg(piece, options)));
    chart += element("div", {{"class", "piece"}}, words + drawing);
    words = Html();
  }
  return element("section", {{"class", "chart"}}, chart);
}

}  // namespace

Html renderFigures(const std::vector<Figure>& figures) {
  Html charts;
  std::string left_out;
  for (const Figure& figure : figures) {
    if (isLeftOut(figure)) {
      left_out += (left_out.empty() ? "" : ", ") + figure.title;
    } else {
      charts += renderChart(figure);
    }
  }
  if (!left_out.empty()) {
    charts += element("p", "Among the plots of the job, not repeated here: " + left_out + ".");
  }
  return charts.empty() ? Html() : element("section", element("h2", "Figures") + charts);
}

}  // namespace gaitmill
