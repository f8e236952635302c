#include "core/io/grf_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/base/error.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

// Ten times the weight of the heaviest human: beyond it the unit is not N.
constexpr double kLargestForce = 1e5;
// A laboratory is shorter; typical loaded points are within 5 m. Millimetres land far outside.
constexpr double kLargestPoint = 50.0;
// Free torques in gait stay below 50 N.m.
constexpr double kLargestTorque = 500.0;
// A plate counts as surely loaded above this part of the peak, when medians judge the units.
constexpr double kSurelyLoaded = 0.3;
// Judging units needs some load even if the threshold is 0 [N].
constexpr double kLeastLoad = 5.0;

using Columns = std::array<int, 3>;

/// The columns of one family in the table.
struct Family {
  std::string name;
  std::string side;  ///< "r", "l" or digits
  Columns force = {-1, -1, -1};
  Columns point = {-1, -1, -1};
  Columns torque = {-1, -1, -1};
};

std::string toLower(std::string text) {
  for (char& c : text) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}

/// Columns by label, in any case: each family asks for up to 24 labels.
class LabelIndex {
 public:
  explicit LabelIndex(const std::vector<std::string>& labels) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      columns_.emplace(toLower(labels[i]), static_cast<int>(i));
    }
  }
  /// The first column of that label, or -1.
  int find(const std::string& label) const {
    const auto found = columns_.find(toLower(label));
    return found == columns_.end() ? -1 : found->second;
  }

 private:
  std::unordered_map<std::string, int> columns_;
};

/// Columns stem+ends[0..2], or nullopt unless all three exist.
std::optional<Columns> findTriple(const LabelIndex& labels,
                                  const std::string& stem,
                                  const std::array<const char*, 3>& ends) {
  Columns columns = {};
  for (std::size_t i = 0; i < 3; ++i) {
    columns[i] = labels.find(stem + ends[i]);
    if (columns[i] < 0) {
      return std::nullopt;
    }
  }
  return columns;
}

bool isNumber(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Side that the letters before and after "ground_force_" state: "r", "l", digits, or "" if these
/// letters are no side at all, so that the columns are something else.
std::optional<std::string> readSide(std::string_view prefix, std::string_view infix) {
  if (prefix.empty() && infix.empty()) {
    return "r";
  }
  if (!prefix.empty() && !infix.empty()) {
    return std::nullopt;
  }
  std::string_view side = prefix.empty() ? infix : prefix;
  if (side.back() != '_') {
    return std::nullopt;
  }
  side.remove_suffix(1);
  if (equalsIgnoringCase(side, "r") || equalsIgnoringCase(side, "right")) {
    return "r";
  }
  if (equalsIgnoringCase(side, "l") || equalsIgnoringCase(side, "left")) {
    return "l";
  }
  // The second foot of files whose first is unnumbered; checked against the others below.
  if (isNumber(side)) {
    return std::string(side) + (prefix.empty() ? "" : "_");
  }
  return std::nullopt;
}

std::optional<Family> makeNamedFamily(const LabelIndex& labels, const std::string& label) {
  const std::string stem = "ground_force_";
  const std::size_t at = label.find(stem);
  if (at == std::string::npos || label.size() < at + stem.size() + 2 ||
      label.substr(label.size() - 2) != "vx") {
    return std::nullopt;
  }
  const std::string prefix = label.substr(0, at);
  const std::string infix = label.substr(at + stem.size(), label.size() - at - stem.size() - 2);
  const std::optional<std::string> side = readSide(prefix, infix);
  const std::string base = prefix + stem + infix;
  const auto force = findTriple(labels, base, {"vx", "vy", "vz"});
  if (!side || !force) {
    return std::nullopt;
  }
  Family family;
  family.name = base.substr(0, base.size() - 1);
  family.side = *side;
  family.force = *force;
  family.point = findTriple(labels, base, {"px", "py", "pz"}).value_or(family.point);
  const std::array<std::string, 5> torque_stems = {prefix + "ground_torque_" + infix,
                                                   prefix + "ground_moment_" + infix,
                                                   prefix + "ground_torque_" + infix + "m",
                                                   prefix + "ground_moment_" + infix + "m",
                                                   base + "m"};
  for (const std::string& torque : torque_stems) {
    if (const auto columns = findTriple(labels, torque, {"x", "y", "z"})) {
      family.torque = *columns;
      break;
    }
  }
  return family;
}

/// f1_1 f1_2 f1_3, p1_1 .., m1_1 .. as the C3D conversion writes them.
std::optional<Family> makeAdapterFamily(const LabelIndex& labels, const std::string& label) {
  const std::size_t underscore = label.find('_');
  if (label.empty() || label[0] != 'f' || underscore == std::string::npos ||
      label.substr(underscore) != "_1" || !isNumber(label.substr(1, underscore - 1))) {
    return std::nullopt;
  }
  const std::string number = label.substr(1, underscore - 1) + "_";
  const auto force = findTriple(labels, "f" + number, {"1", "2", "3"});
  if (!force) {
    return std::nullopt;
  }
  Family family;
  family.name = label.substr(0, underscore);
  family.side = label.substr(1, underscore - 1);
  family.force = *force;
  family.point = findTriple(labels, "p" + number, {"1", "2", "3"}).value_or(family.point);
  family.torque = findTriple(labels, "m" + number, {"1", "2", "3"}).value_or(family.torque);
  return family;
}

std::vector<Family> findFamilies(const std::vector<std::string>& labels) {
  const LabelIndex index(labels);
  std::vector<Family> families;
  for (const std::string& label : labels) {
    std::optional<Family> family = makeNamedFamily(index, label);
    if (!family) {
      family = makeAdapterFamily(index, label);
    }
    if (family) {
      families.push_back(std::move(*family));
    }
  }
  // "1_ground_force" is the left foot only where an unnumbered family is the right one.
  const bool has_plain = std::any_of(
      families.begin(), families.end(), [](const Family& f) { return f.name == "ground_force"; });
  for (Family& family : families) {
    if (family.side == "1_" && has_plain) {
      family.side = "l";
    } else if (family.side.back() == '_') {
      family.side.pop_back();
    }
  }
  return families;
}

std::string listNames(const std::vector<Family>& families) {
  std::string list;
  for (const Family& family : families) {
    list += (list.empty() ? "" : ", ") + family.name;
  }
  return list;
}

/// Reads the forces of one table, family by family.
class GrfBuilder {
 public:
  GrfBuilder(const TableFile& file, const GrfOptions& options)
      : file_(file), options_(options), families_(findFamilies(file.table.labels)) {}

  GroundReaction build() {
    requireFamilies();
    GroundReaction reaction;
    reaction.time = file_.table.time;
    for (const Family& family : families_) {
      const std::string body = findBody(family);
      if (!body.empty()) {
        reaction.forces.push_back(makeForce(family, body));
      }
    }
    if (reaction.forces.empty()) {
      fail(ErrorCode::kGrfColumns, "no column family is assigned to a body", nullptr);
    }
    requireLoad(reaction);
    return reaction;
  }

 private:
  void requireFamilies() const;
  std::string findBody(const Family& family) const;
  ExternalForce makeForce(const Family& family, const std::string& body) const;
  Eigen::Matrix3Xd copy(const Columns& columns) const;
  void requireNumbers(const Family& family, const ExternalForce& force) const;
  void requireUnits(const Family& family, const ExternalForce& force) const;
  void requireLoad(const GroundReaction& reaction) const;
  void gate(ExternalForce& force) const;
  [[noreturn]] void fail(ErrorCode code, const std::string& message, const Family* family) const;
  [[noreturn]] void failAt(Eigen::Index row, int column, const std::string& message) const;

  const TableFile& file_;
  const GrfOptions& options_;
  std::vector<Family> families_;
};

void GrfBuilder::fail(ErrorCode code, const std::string& message, const Family* family) const {
  Where where{file_.file_name, file_.label_line, 1, {}};
  if (family != nullptr) {
    where.column = file_.label_columns[static_cast<std::size_t>(family->force[0])];
    where.field = family->name;
  }
  throw Error(code, message, where);
}

void GrfBuilder::failAt(Eigen::Index row, int column, const std::string& message) const {
  throw Error(ErrorCode::kGrfValue,
              message,
              {file_.file_name,
               file_.row_lines[static_cast<std::size_t>(row)],
               0,
               file_.table.labels[static_cast<std::size_t>(column)]});
}

void GrfBuilder::requireFamilies() const {
  if (families_.empty()) {
    fail(ErrorCode::kGrfColumns,
         "no ground reaction columns found; expected for instance ground_force_r_vx, _vy, _vz",
         nullptr);
  }
  for (const PlateAssignment& plate : options_.plates) {
    const bool known = std::any_of(families_.begin(), families_.end(), [&](const Family& family) {
      return family.name == plate.family;
    });
    if (!known) {
      fail(ErrorCode::kGrfColumns,
           "there are no columns '" + plate.family + "'; found " + listNames(families_),
           nullptr);
    }
  }
}

std::string GrfBuilder::findBody(const Family& family) const {
  for (const PlateAssignment& plate : options_.plates) {
    if (plate.family == family.name) {
      return plate.body;
    }
  }
  if (!options_.plates.empty()) {
    return "";
  }
  if (family.side != "r" && family.side != "l") {
    fail(ErrorCode::kGrfColumns,
         "columns '" + family.name + "' name a plate, not a foot; assign plates to feet (found " +
             listNames(families_) + ")",
         &family);
  }
  return family.side == "r" ? options_.right_body : options_.left_body;
}

Eigen::Matrix3Xd GrfBuilder::copy(const Columns& columns) const {
  Eigen::Matrix3Xd vectors = Eigen::Matrix3Xd::Zero(3, file_.table.rowCount());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const int column = columns[static_cast<std::size_t>(axis)];
    if (column >= 0) {
      vectors.row(axis) = file_.table.values.col(column).transpose();
    }
  }
  return vectors;
}

void GrfBuilder::requireNumbers(const Family& family, const ExternalForce& force) const {
  for (Eigen::Index row = 0; row < force.force.cols(); ++row) {
    const bool loaded =
        std::abs(force.force(1, row)) >= options_.threshold && force.force(1, row) != 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (!std::isfinite(force.force(axis, row))) {
        failAt(row, family.force[i], "a force is missing");
      }
      if (loaded && !std::isfinite(force.point(axis, row))) {
        failAt(row, family.point[i], "the centre of pressure is missing while the plate is loaded");
      }
      if (loaded && !std::isfinite(force.torque(axis, row))) {
        failAt(row, family.torque[i], "a torque is missing while the plate is loaded");
      }
    }
  }
}

double findMedian(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void GrfBuilder::requireUnits(const Family& family, const ExternalForce& force) const {
  const double peak = force.force.row(1).cwiseAbs().maxCoeff();
  if (peak > kLargestForce) {
    fail(ErrorCode::kGrfUnits,
         "vertical force reaches " + formatNumber(peak) + ", which cannot be newtons",
         &family);
  }
  if (peak < std::max(kLeastLoad, options_.threshold)) {
    return;
  }
  std::vector<double> vertical;
  std::vector<double> distance;
  std::vector<double> twist;
  for (Eigen::Index row = 0; row < force.force.cols(); ++row) {
    if (std::abs(force.force(1, row)) > kSurelyLoaded * peak) {
      vertical.push_back(force.force(1, row));
      distance.push_back(force.point.col(row).norm());
      twist.push_back(force.torque.col(row).norm());
    }
  }
  if (findMedian(vertical) < 0) {
    fail(ErrorCode::kGrfUnits,
         "the vertical force points down; forces on the subject, Y up, are expected",
         &family);
  }
  if (const double median = findMedian(distance); median > kLargestPoint) {
    fail(
        ErrorCode::kGrfUnits,
        "centres of pressure lie " + formatNumber(median) + " from the origin; metres are expected",
        &family);
  }
  if (const double median = findMedian(twist); median > kLargestTorque) {
    fail(ErrorCode::kGrfUnits,
         "free torques are around " + formatNumber(median) + "; N.m are expected",
         &family);
  }
}

void GrfBuilder::requireLoad(const GroundReaction& reaction) const {
  const double least = std::max(kLeastLoad, options_.threshold);
  const bool any =
      std::any_of(reaction.forces.begin(), reaction.forces.end(), [&](const ExternalForce& force) {
        return force.force.row(1).maxCoeff() >= least;
      });
  if (!any) {
    fail(ErrorCode::kGrfUnits,
         "no vertical force (second component, Y up) ever reaches " + formatNumber(least) + " N",
         nullptr);
  }
}

void GrfBuilder::gate(ExternalForce& force) const {
  for (Eigen::Index row = 0; row < force.force.cols(); ++row) {
    if (std::abs(force.force(1, row)) < options_.threshold) {
      force.force.col(row).setZero();
      force.torque.col(row).setZero();
    }
  }
}

ExternalForce GrfBuilder::makeForce(const Family& family, const std::string& body) const {
  if (family.point[0] < 0) {
    fail(ErrorCode::kGrfColumns,
         "columns '" + family.name + "' state no centre of pressure (px, py, pz)",
         &family);
  }
  ExternalForce force;
  force.name = family.name;
  force.body = body;
  force.force = copy(family.force);
  force.point = copy(family.point);
  force.torque = copy(family.torque);
  requireNumbers(family, force);
  requireUnits(family, force);
  gate(force);
  return force;
}

}  // namespace

std::vector<std::string> findForceFamilies(const std::vector<std::string>& labels) {
  std::vector<std::string> names;
  for (const Family& family : findFamilies(labels)) {
    names.push_back(family.name);
  }
  return names;
}

std::vector<Foot> findFamilyFeet(const std::vector<std::string>& labels) {
  std::vector<Foot> feet;
  for (const Family& family : findFamilies(labels)) {
    feet.push_back(family.side == "r"   ? Foot::kRight
                   : family.side == "l" ? Foot::kLeft
                                        : Foot::kUnknown);
  }
  return feet;
}

GroundReaction readGroundReaction(const TableFile& file, const GrfOptions& options) {
  return GrfBuilder(file, options).build();
}

}  // namespace gaitmill
