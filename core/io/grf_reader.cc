#include "core/io/grf_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
// Missing centres of pressure are bridged that far into a contact [s].
constexpr double kLongestEdge = 0.020;
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

Eigen::Matrix3Xd copyColumns(const TableFile& file, const Columns& columns, double absent) {
  Eigen::Matrix3Xd vectors = Eigen::Matrix3Xd::Constant(3, file.table.rowCount(), absent);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const int column = columns[static_cast<std::size_t>(axis)];
    if (column >= 0) {
      vectors.row(axis) = file.table.values.col(column).transpose();
    }
  }
  return vectors;
}

/// Takes the forces that feet use, family by family.
class ForceSelection {
 public:
  ForceSelection(GroundReaction all,
                 const std::vector<Foot>& feet,
                 const GrfOptions& options,
                 const TableFile* file,
                 std::vector<std::string>* warnings)
      : all_(std::move(all)), feet_(feet), options_(options), file_(file), warnings_(warnings) {
    if (file != nullptr) {
      families_ = findFamilies(file->table.labels);
    }
  }

  GroundReaction select() {
    requireKnownPlates();
    GroundReaction reaction;
    reaction.time = all_.time;
    for (std::size_t i = 0; i < all_.forces.size(); ++i) {
      ExternalForce& force = all_.forces[i];
      force.body = findBody(force.name, feet_[i]);
      const bool is_kept = options_.plates.empty() && options_.unnamed == UnnamedPlates::kKeep;
      if (!force.body.empty() || is_kept) {
        bridgeEdges(force);
        checkForce(force);
        gate(force);
        reaction.forces.push_back(std::move(force));
      }
    }
    if (reaction.forces.empty()) {
      fail(ErrorCode::kGrfColumns, "no column family is assigned to a body", "");
    }
    requireLoad(reaction);
    return reaction;
  }

 private:
  std::string listNames() const;
  void requireKnownPlates() const;
  std::string findBody(const std::string& name, Foot foot) const;
  void checkForce(const ExternalForce& force) const;
  void requireNumbers(const ExternalForce& force) const;
  void requireUnits(const ExternalForce& force) const;
  void requireLoad(const GroundReaction& reaction) const;
  void gate(ExternalForce& force) const;
  void bridgeEdges(ExternalForce& force) const;
  bool isLoaded(const ExternalForce& force, Eigen::Index row) const;
  const Family* findFamily(const std::string& name) const;
  [[noreturn]] void fail(ErrorCode code,
                         const std::string& message,
                         const std::string& family) const;
  enum class Quantity { kForce, kPoint, kTorque };
  [[noreturn]] void failAt(const ExternalForce& force,
                           Quantity quantity,
                           Eigen::Index axis,
                           Eigen::Index row,
                           const std::string& message) const;

  GroundReaction all_;
  const std::vector<Foot>& feet_;
  const GrfOptions& options_;
  const TableFile* file_;
  std::vector<std::string>* warnings_;
  std::vector<Family> families_;
};

const Family* ForceSelection::findFamily(const std::string& name) const {
  const auto found = std::find_if(
      families_.begin(), families_.end(), [&](const Family& one) { return one.name == name; });
  return found == families_.end() ? nullptr : &*found;
}

std::string ForceSelection::listNames() const {
  std::string list;
  for (const ExternalForce& force : all_.forces) {
    list += (list.empty() ? "" : ", ") + force.name;
  }
  return list;
}

void ForceSelection::fail(ErrorCode code,
                          const std::string& message,
                          const std::string& family) const {
  Where where;
  where.field = family;
  if (file_ != nullptr) {
    where.file = file_->file_name;
    where.line = file_->label_line;
    where.column = 1;
    if (const Family* found = findFamily(family)) {
      where.column = file_->label_columns[static_cast<std::size_t>(found->force[0])];
    }
  }
  throw Error(code, message, where);
}

void ForceSelection::failAt(const ExternalForce& force,
                            Quantity quantity,
                            Eigen::Index axis,
                            Eigen::Index row,
                            const std::string& message) const {
  Where where;
  where.field = force.name;
  where.time = all_.time[static_cast<std::size_t>(row)];
  const Family* family = findFamily(force.name);
  if (family != nullptr) {
    const Columns& columns = quantity == Quantity::kForce   ? family->force
                             : quantity == Quantity::kPoint ? family->point
                                                            : family->torque;
    where.file = file_->file_name;
    where.line = file_->row_lines[static_cast<std::size_t>(row)];
    where.field =
        file_->table.labels[static_cast<std::size_t>(columns[static_cast<std::size_t>(axis)])];
  }
  throw Error(ErrorCode::kGrfValue, message, where);
}

void ForceSelection::requireKnownPlates() const {
  for (const PlateAssignment& plate : options_.plates) {
    const bool known =
        std::any_of(all_.forces.begin(), all_.forces.end(), [&](const ExternalForce& force) {
          return force.name == plate.family;
        });
    if (!known) {
      fail(ErrorCode::kGrfColumns,
           "there are no columns '" + plate.family + "'; found " + listNames(),
           "");
    }
  }
}

std::string ForceSelection::findBody(const std::string& name, Foot foot) const {
  for (const PlateAssignment& plate : options_.plates) {
    if (plate.family == name) {
      return plate.body;
    }
  }
  if (!options_.plates.empty()) {
    return "";
  }
  if (foot == Foot::kUnknown && options_.unnamed == UnnamedPlates::kKeep) {
    return "";
  }
  if (foot == Foot::kUnknown) {
    fail(ErrorCode::kGrfColumns,
         "columns '" + name + "' name a plate, not a foot; assign plates to feet (found " +
             listNames() + ")",
         name);
  }
  return foot == Foot::kRight ? options_.right_body : options_.left_body;
}

bool ForceSelection::isLoaded(const ExternalForce& force, Eigen::Index row) const {
  return std::abs(force.force(1, row)) >= options_.threshold && force.force(1, row) != 0;
}

void ForceSelection::bridgeEdges(ExternalForce& force) const {
  const auto time = [&](Eigen::Index row) {
    return all_.time[static_cast<std::size_t>(row)];
  };
  const auto is_known = [&](Eigen::Index row) {
    return force.point.col(row).allFinite() && force.torque.col(row).allFinite();
  };
  const auto copy = [&](Eigen::Index from, Eigen::Index to) {
    force.point.col(to) = force.point.col(from);
    force.torque.col(to) = force.torque.col(from);
  };
  int bridged = 0;
  double first_time = 0;
  const Eigen::Index rows = force.force.cols();
  for (Eigen::Index first = 0; first < rows; ++first) {
    if (!isLoaded(force, first)) {
      continue;
    }
    Eigen::Index last = first;
    while (last + 1 < rows && isLoaded(force, last + 1)) {
      ++last;
    }
    Eigen::Index known_first = first;
    while (known_first <= last && !is_known(known_first)) {
      ++known_first;
    }
    Eigen::Index known_last = last;
    while (known_last > known_first && !is_known(known_last)) {
      --known_last;
    }
    const bool is_blip = known_first > last && time(last) - time(first) <= kLongestEdge;
    if (is_blip) {
      force.force.middleCols(first, last - first + 1).setZero();
      force.torque.middleCols(first, last - first + 1).setZero();
    }
    const bool at_start = known_first <= last && time(known_first) - time(first) <= kLongestEdge;
    for (Eigen::Index row = first; at_start && row < known_first; ++row) {
      copy(known_first, row);
    }
    const bool at_end = known_first <= last && time(last) - time(known_last) <= kLongestEdge;
    for (Eigen::Index row = known_last + 1; at_end && row <= last; ++row) {
      copy(known_last, row);
    }
    const bool missing = known_first > first || known_last < last;
    if (missing && (is_blip || at_start || at_end)) {
      first_time = bridged == 0 ? time(first) : first_time;
      ++bridged;
    }
    first = last;
  }
  if (bridged > 0 && warnings_ != nullptr) {
    warnings_->push_back("'" + force.name +
                         "': the centre of pressure is missing at the edges of " +
                         std::to_string(bridged) + " contacts, first near " +
                         formatNumber(first_time) + " s; the nearest known one is used");
  }
}

void ForceSelection::requireNumbers(const ExternalForce& force) const {
  for (Eigen::Index row = 0; row < force.force.cols(); ++row) {
    const bool loaded = isLoaded(force, row);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(force.force(axis, row))) {
        failAt(force, Quantity::kForce, axis, row, "a force is missing");
      }
      if (loaded && !std::isfinite(force.point(axis, row))) {
        failAt(force,
               Quantity::kPoint,
               axis,
               row,
               "the centre of pressure is missing while the plate is loaded");
      }
      if (loaded && !std::isfinite(force.torque(axis, row))) {
        failAt(
            force, Quantity::kTorque, axis, row, "a torque is missing while the plate is loaded");
      }
    }
  }
}

double findMedian(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void ForceSelection::requireUnits(const ExternalForce& force) const {
  const double peak = force.force.row(1).cwiseAbs().maxCoeff();
  if (peak > kLargestForce) {
    fail(ErrorCode::kGrfUnits,
         "vertical force reaches " + formatNumber(peak) + ", which cannot be newtons",
         force.name);
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
         force.name);
  }
  if (const double median = findMedian(distance); median > kLargestPoint) {
    fail(
        ErrorCode::kGrfUnits,
        "centres of pressure lie " + formatNumber(median) + " from the origin; metres are expected",
        force.name);
  }
  if (const double median = findMedian(twist); median > kLargestTorque) {
    fail(ErrorCode::kGrfUnits,
         "free torques are around " + formatNumber(median) + "; N.m are expected",
         force.name);
  }
}

void ForceSelection::requireLoad(const GroundReaction& reaction) const {
  const double least = std::max(kLeastLoad, options_.threshold);
  const bool any =
      std::any_of(reaction.forces.begin(), reaction.forces.end(), [&](const ExternalForce& force) {
        return force.force.row(1).maxCoeff() >= least;
      });
  if (!any) {
    fail(ErrorCode::kGrfUnits,
         "no vertical force (second component, Y up) ever reaches " + formatNumber(least) + " N",
         "");
  }
}

void ForceSelection::gate(ExternalForce& force) const {
  for (Eigen::Index row = 0; row < force.force.cols(); ++row) {
    if (std::abs(force.force(1, row)) < options_.threshold) {
      force.force.col(row).setZero();
      force.torque.col(row).setZero();
    }
  }
}

void ForceSelection::checkForce(const ExternalForce& force) const {
  const bool is_loaded = (force.force.row(1).array().abs() >= options_.threshold).any();
  if (is_loaded && !force.point.array().isFinite().any()) {
    fail(ErrorCode::kGrfColumns,
         "columns '" + force.name + "' state no centre of pressure (px, py, pz)",
         force.name);
  }
  requireNumbers(force);
  requireUnits(force);
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

GroundReaction readForceColumns(const TableFile& file) {
  GroundReaction all;
  all.time = file.table.time;
  for (const Family& family : findFamilies(file.table.labels)) {
    ExternalForce force;
    force.name = family.name;
    force.force = copyColumns(file, family.force, 0);
    force.point = copyColumns(file, family.point, std::numeric_limits<double>::quiet_NaN());
    force.torque = copyColumns(file, family.torque, 0);
    all.forces.push_back(std::move(force));
  }
  require(!all.forces.empty(),
          ErrorCode::kGrfColumns,
          "no ground reaction columns found; expected for instance ground_force_r_vx, _vy, _vz",
          {file.file_name, file.label_line, 1, {}});
  return all;
}

GroundReaction selectForces(GroundReaction all,
                            const std::vector<Foot>& feet,
                            const GrfOptions& options,
                            const TableFile* file,
                            std::vector<std::string>* warnings) {
  check(feet.size() == all.forces.size(), "every force needs its foot, known or not");
  return ForceSelection(std::move(all), feet, options, file, warnings).select();
}

GroundReaction readGroundReaction(const TableFile& file, const GrfOptions& options) {
  return selectForces(readForceColumns(file), findFamilyFeet(file.table.labels), options, &file);
}

}  // namespace gaitmill
