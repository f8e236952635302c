#include <algorithm>
#include <cstddef>
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

// One panel per muscle: they say what the muscles do, not how far to trust it.
constexpr const char* kLeftOut[] = {
    "muscle_forces", "fiber_lengths", "fiber_velocities", "muscle_powers"};

bool isLeftOut(const Figure& figure) {
  return std::find(std::begin(kLeftOut), std::end(kLeftOut), figure.name) != std::end(kLeftOut);
}

/// Rows of panels that fit on a page below their heading; narrow panels are lower.
std::size_t findRowsPerPage(const Figure& figure) {
  return figure.columns <= 1 ? 2 : figure.columns == 2 ? 3 : 4;
}

/// The figure in pieces of a page each: paper cannot break a drawing.
std::vector<Figure> splitIntoPages(const Figure& figure) {
  const std::size_t panels =
      findRowsPerPage(figure) * static_cast<std::size_t>(std::max(1, figure.columns));
  std::vector<Figure> pages;
  for (std::size_t first = 0; first < figure.panels.size(); first += panels) {
    const auto begin = figure.panels.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = figure.panels.begin() +
                     static_cast<std::ptrdiff_t>(std::min(first + panels, figure.panels.size()));
    Figure page;
    page.name = figure.name;
    page.title = figure.title;
    page.caption = figure.caption;
    page.columns = figure.columns;
    page.panels.assign(begin, end);
    pages.push_back(std::move(page));
  }
  return pages;
}

/// On a phone a chart keeps a legible size and scrolls by itself.
Html renderChart(const Figure& figure) {
  SvgOptions options;
  options.width = kChartWidth;
  Html chart = element("h3", figure.title) + element("p", figure.caption);
  for (const Figure& page : splitIntoPages(figure)) {
    chart += element(
        "div",
        {{"class", "wide"}, {"role", "region"}, {"tabindex", "0"}, {"aria-label", figure.title}},
        trusted(renderSvg(page, options)));
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
