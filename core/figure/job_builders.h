#pragma once

#include "core/data/figure.h"
#include "core/figure/job_data.h"

namespace gaitmill {

// Each fills the panels of a figure whose name, title and caption stand already, and may add
// sentences to the caption. Private to core/figure; job_figures.cc has the table of all.
void buildJointAngles(const JobData& data, Figure& figure);
void buildMoments(const JobData& data, Figure& figure);
void buildMomentParts(const JobData& data, Figure& figure);
void buildJointPowers(const JobData& data, Figure& figure);
void buildResiduals(const JobData& data, Figure& figure);
void buildReserves(const JobData& data, Figure& figure);
void buildActivations(const JobData& data, Figure& figure);
void buildActivationsEmg(const JobData& data, Figure& figure);
void buildMuscleForces(const JobData& data, Figure& figure);
void buildFiberLengths(const JobData& data, Figure& figure);
void buildFiberVelocities(const JobData& data, Figure& figure);
void buildMusclePowers(const JobData& data, Figure& figure);
void buildMuscleWork(const JobData& data, Figure& figure);
void buildJointReactions(const JobData& data, Figure& figure);
void buildGroundReactions(const JobData& data, Figure& figure);
void buildMarkerErrors(const JobData& data, Figure& figure);
void buildTrackingErrors(const JobData& data, Figure& figure);
void buildPaperFigure4(const JobData& data, Figure& figure);
void buildPaperFigure5(const JobData& data, Figure& figure);
void buildPaperSupplementalFigure4(const JobData& data, Figure& figure);

/// A panel over the job's axis, without curves yet.
Panel makePanel(const JobData& data, const std::string& name, const std::string& title, Axis y);

}  // namespace gaitmill
