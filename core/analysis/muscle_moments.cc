#include "core/analysis/muscle_moments.h"

#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/model/free_coordinates.h"
#include "core/model/muscle_paths.h"

namespace gaitmill {

namespace {

// Columns of a table that name entries of a list: (column, position in the list).
using Columns = std::vector<std::pair<int, int>>;

Columns findColumns(const TimeSeries& table, const std::vector<std::string>& names) {
  Columns columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const std::optional<int> column = table.findColumn(names[i])) {
      columns.emplace_back(*column, static_cast<int>(i));
    }
  }
  return columns;
}

std::vector<std::string> findMuscleNames(const Model& model) {
  std::vector<std::string> names;
  for (const MuscleSpec& muscle : model.spec().muscles) {
    names.push_back(muscle.name);
  }
  return names;
}

std::vector<int> findFreeColumns(const Model& model,
                                 const FreeCoordinates& free,
                                 const std::vector<std::string>& coordinates) {
  std::vector<int> columns;
  for (const std::string& name : coordinates) {
    columns.push_back(free.findFree(model.getCoordinate(name)));
    require(columns.back() >= 0,
            ErrorCode::kInputCoordinates,
            "coordinate '" + name + "' is locked or follows another: muscles have no moment of it",
            atCoordinate(name));
  }
  return columns;
}

}  // namespace

TimeSeries calcMuscleMoments(const Model& model,
                             const TimeSeries& pose,
                             const TimeSeries& tendon_forces,
                             const std::vector<std::string>& coordinates) {
  require(pose.rowCount() > 0, ErrorCode::kTableNoRows, "table '" + pose.name + "' has no rows");
  const FreeCoordinates free(model);
  const std::vector<int> wanted = findFreeColumns(model, free, coordinates);
  const Columns pose_columns = findColumns(pose, model.coordinateNames());
  const Columns force_columns = findColumns(tendon_forces, findMuscleNames(model));

  ModelState state(model);
  MusclePaths paths(model);
  Eigen::VectorXd q = model.defaultPose();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(model.muscleCount());
  RowMatrix arms(model.muscleCount(), free.count());
  TimeSeries moments = makeTimeSeries("muscle moments", coordinates, tendon_forces.time);
  moments.units.assign(coordinates.size(), "N.m");
  for (int row = 0; row < tendon_forces.rowCount(); ++row) {
    const Eigen::VectorXd pose_row = pose.interpolate(moments.time[static_cast<std::size_t>(row)]);
    for (const auto& [column, coordinate] : pose_columns) {
      q[coordinate] = pose_row[column];
    }
    free.conformPose(q);
    state.setPose(q);
    paths.calc(state);
    free.reduceColumns(paths.momentArms(), arms);
    for (const auto& [column, muscle] : force_columns) {
      force[muscle] = tendon_forces.values(row, column);
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      moments.values(row, static_cast<Eigen::Index>(i)) = arms.col(wanted[i]).dot(force);
    }
  }
  return moments;
}

}  // namespace gaitmill
