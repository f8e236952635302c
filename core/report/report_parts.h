#pragma once

#include <string>
#include <vector>

#include "core/report/html.h"
#include "core/report/json_access.h"
#include "core/report/report.h"

namespace gaitmill {

// The parts of a report, each made from the summary alone or from what goes with it. A part whose
// figures are not there is empty.

/// Colour, symbol and word, so that none of them is needed to read it.
Html renderVerdict(const std::string& verdict);
/// "1.84", "12.3", "120": three digits; "–" for what is not a number. @param scale  to the unit
/// shown
Html renderFigure(double value, double scale = 1);
/// "ik" -> "Inverse kinematics"
std::string stageTitle(const std::string& stage);

/// Title, subject, overall verdict and the sentence why.
Html renderHeader(const ReportProvenance& provenance, const Json& summary);
/// Verdicts of the stages and what each of them found, with links.
Html renderOverview(const Json& summary);
/// Inputs, model, settings, version, hashes.
Html renderProvenance(const ReportProvenance& provenance, const Json& summary);
Html renderPoses(const std::vector<ReportImage>& images);
/// The checks of a stage, what to do about those that do not pass, and its tables.
Html renderStage(const std::string& stage, const Json& summary);
Html renderFigures(const std::vector<Figure>& figures);
/// Every sentence that the pipeline warned with.
Html renderWarnings(const Json& summary);
/// What the limits are taken from, and what made this page.
Html renderFooter(const ReportProvenance& provenance);

/// Tables of one stage: markers, passes, actuators, moments.
Html renderStageTables(const std::string& stage, const Json& summary);
/// How the muscles' times of activity agree with the measured ones.
Html renderEmg(const Json& summary);

/// The sheet of style for screen and paper.
const char* reportStyle();

}  // namespace gaitmill
