#include "core/io/c3d_plates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <Eigen/Geometry>

#include "core/io/number_text.h"

namespace gaitmill {

namespace {

constexpr double kLeastNormalForce = 1e-3;  // [N] below it a centre of pressure is a division by 0
constexpr double kSurelyLoaded = 200.0;     // [N] vertical force of a foot beyond doubt
constexpr double kShortestEdge = 1e-3;      // [m] of a plate
constexpr double kFarthestCorner = 1e3;     // [m] from the laboratory's origin
constexpr std::size_t kMostPlates = 255;
constexpr int kLeastChannels = 3;  // a vertical force and two moments, as of some treadmills

using Channels = std::array<double, 8>;

/// Force and moment about the centre of the plate's surface, in plate axes [N, N.m].
struct Wrench {
  Eigen::Vector3d force;
  Eigen::Vector3d moment;
};

/// Position and calibration of one plate, in SI.
struct PlateGeometry {
  Eigen::Matrix3d R_GP;    // plate axes in the laboratory; z points along the normal, mostly down
  Eigen::Vector3d p_GC;    // centre of the surface [m]
  Eigen::Vector3d origin;  // from the sensors' origin to the centre of the surface [m]
  Eigen::Matrix<double, 6, 6> calibration = Eigen::Matrix<double, 6, 6>::Identity();
  std::array<double, 8> units;  // that bring each channel to N, N.m, m
};

// The instrument makers' definitions of the types: C3D format, FORCE_PLATFORM:TYPE.
Wrench calcType1(const PlateGeometry&, const Channels& c) {
  const double x = c[3];
  const double y = c[4];
  return {{c[0], c[1], c[2]}, {y * c[2], -x * c[2], c[5] + x * c[1] - y * c[0]}};
}

Wrench calcType2(const PlateGeometry& plate, const Channels& c) {
  const Eigen::Vector3d force(c[0], c[1], c[2]);
  return {force, Eigen::Vector3d(c[3], c[4], c[5]) + force.cross(plate.origin)};
}

// Four three-component sensors at (+-a, +-b). The distances are positive by their meaning; where a
// file turned the whole origin around, so were they.
Wrench calcType3(const PlateGeometry& plate, const Channels& c) {
  const double a = std::abs(plate.origin.x());
  const double b = std::abs(plate.origin.y());
  const Eigen::Vector3d force(c[0] + c[1], c[2] + c[3], c[4] + c[5] + c[6] + c[7]);
  const Eigen::Vector3d moment(b * (c[4] + c[5] - c[6] - c[7]),
                               a * (-c[4] + c[5] + c[6] - c[7]),
                               b * (c[1] - c[0]) + a * (c[2] - c[3]));
  return {force, moment + force.cross(Eigen::Vector3d(0, 0, plate.origin.z()))};
}

Wrench calcType4(const PlateGeometry& plate, const Channels& c) {
  const Eigen::Matrix<double, 6, 1> raw = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(c.data());
  const Eigen::Matrix<double, 6, 1> wrench = plate.calibration * raw;
  const Eigen::Vector3d force = wrench.head<3>();
  return {force, wrench.tail<3>() + force.cross(plate.origin)};
}

enum class Quantity { kForce, kMoment, kLength, kRaw };

struct PlateType {
  int number;
  std::size_t channel_count;
  std::array<Quantity, 8> quantities;
  std::array<std::size_t, 4> normal_channels;  // without which there is no vertical force
  Wrench (*calc)(const PlateGeometry&, const Channels&);
};

const PlateType* findType(int number) {
  constexpr auto kF = Quantity::kForce;
  constexpr auto kM = Quantity::kMoment;
  constexpr auto kL = Quantity::kLength;
  constexpr auto kR = Quantity::kRaw;
  static constexpr std::array<PlateType, 4> kTypes = {{
      {1, 6, {kF, kF, kF, kL, kL, kM, kR, kR}, {2, 2, 2, 2}, calcType1},
      {2, 6, {kF, kF, kF, kM, kM, kM, kR, kR}, {2, 2, 2, 2}, calcType2},
      {3, 8, {kF, kF, kF, kF, kF, kF, kF, kF}, {4, 5, 6, 7}, calcType3},
      {4, 6, {kR, kR, kR, kR, kR, kR, kR, kR}, {2, 2, 2, 2}, calcType4},
  }};
  for (const PlateType& type : kTypes) {
    if (type.number == number) {
      return &type;
    }
  }
  return nullptr;
}

std::string describeUnsupportedType(int number) {
  static const std::map<int, std::string> kNames = {{5, "Kistler split-belt, eight channels"},
                                                    {6, "twelve channels of corner sensors"},
                                                    {7, "eight channels with a calibration matrix"},
                                                    {11, "instrumented treadmill"},
                                                    {12, "instrumented treadmill"},
                                                    {21, "stairs"}};
  const auto known = kNames.find(number);
  return "its type is " + std::to_string(number) +
         (known == kNames.end() ? "" : " (" + known->second + ")") +
         "; types 1 to 4 are read. Export its forces as a table of ground reactions";
}

/// Factor of a stated unit to SI, or nullopt if the text says something else.
std::optional<double> findUnit(Quantity quantity, const std::string& stated) {
  std::string unit;
  for (const char c : stated) {
    if (c != '.' && c != '*' && c != '-' && c != ' ') {
      unit += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
  }
  static const std::map<std::string, double> kForces = {
      {"n", 1}, {"nt", 1}, {"newton", 1}, {"newtons", 1}, {"kn", 1e3}};
  static const std::map<std::string, double> kMoments = {
      {"nmm", 1e-3}, {"ntmm", 1e-3}, {"ncm", 1e-2}, {"ntcm", 1e-2}, {"nm", 1}, {"ntm", 1}};
  static const std::map<std::string, double> kLengths = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}};
  const std::map<std::string, double>& units = quantity == Quantity::kForce    ? kForces
                                               : quantity == Quantity::kMoment ? kMoments
                                                                               : kLengths;
  const auto found = units.find(unit);
  return found == units.end() ? std::nullopt : std::optional<double>(found->second);
}

class PlateReader {
 public:
  PlateReader(const C3dParameters& parameters,
              RowMatrix& analog,
              const C3dPlateInput& input,
              std::vector<std::string>& warnings)
      : analog_(analog),
        input_(input),
        warnings_(warnings),
        types_(parameters.findAllNumbers("FORCE_PLATFORM", "TYPE")),
        corners_(parameters.findAllNumbers("FORCE_PLATFORM", "CORNERS")),
        origins_(parameters.findAllNumbers("FORCE_PLATFORM", "ORIGIN")),
        channels_(parameters.findAllSignedNumbers("FORCE_PLATFORM", "CHANNEL")),
        matrices_(parameters.findAllNumbers("FORCE_PLATFORM", "CAL_MATRIX")),
        zero_(parameters.findSignedNumbers("FORCE_PLATFORM", "ZERO")) {
    const C3dParameter* const channel = parameters.find("FORCE_PLATFORM", "CHANNEL");
    channel_stride_ =
        channel == nullptr || channel->dimensions.empty() ? 6 : channel->dimensions[0];
    const double used = parameters.findNumber("FORCE_PLATFORM", "USED").value_or(0);
    count_ = static_cast<std::size_t>(std::max(0L, toInteger(used)));
  }

  C3dPlates read();

 private:
  void readPlate(std::size_t index);
  std::string readGeometry(std::size_t index, C3dPlate& plate, PlateGeometry& geometry) const;
  std::string readCalibration(std::size_t index, int type, PlateGeometry& geometry) const;
  std::string claimChannels(std::size_t index, const PlateType* type);
  void findUnits(const C3dPlate& plate, const PlateType& type, PlateGeometry& geometry);
  void subtractBaseline();
  ExternalForce calcForce(const PlateType& type, const PlateGeometry& geometry);
  void turnToSubject(const Eigen::Matrix3d& R_GP, ExternalForce& force);
  Eigen::Index channelCount() const { return analog_.cols(); }

  RowMatrix& analog_;
  const C3dPlateInput& input_;
  std::vector<std::string>& warnings_;
  std::vector<double> types_;
  std::vector<double> corners_;
  std::vector<double> origins_;
  std::vector<double> channels_;
  std::vector<double> matrices_;
  std::vector<double> zero_;
  std::size_t channel_stride_ = 6;
  std::size_t count_ = 0;
  std::vector<Eigen::Index> columns_;  // of the plate at hand in `analog_`, -1 = none
  C3dPlates result_;
};

C3dPlates PlateReader::read() {
  result_.plate_channels.assign(static_cast<std::size_t>(channelCount()), false);
  if (count_ > kMostPlates) {
    warnings_.push_back("FORCE_PLATFORM:USED states " + std::to_string(count_) +
                        " plates; they were left out");
    return std::move(result_);
  }
  if (input_.subtract_baseline) {
    subtractBaseline();
  }
  for (std::size_t i = 0; i < count_; ++i) {
    readPlate(i);
  }
  return std::move(result_);
}

// ZERO counts frames of points from 1; (1, 0) and (0, 0) mean none.
void PlateReader::subtractBaseline() {
  if (zero_.size() < 2 || !(zero_[0] >= 1) || !(zero_[1] >= zero_[0])) {
    return;
  }
  const Eigen::Index first = (toInteger(zero_[0]) - 1) * input_.subframe_count;
  const Eigen::Index end = toInteger(zero_[1]) * input_.subframe_count;
  if (end > analog_.rows()) {
    warnings_.push_back("FORCE_PLATFORM:ZERO names frames that the file does not have");
    return;
  }
  for (const double channel : channels_) {
    const Eigen::Index column = toInteger(channel) - 1;
    if (column >= 0 && column < channelCount()) {
      const double baseline = analog_.col(column).segment(first, end - first).mean();
      analog_.col(column).array() -= baseline;
    }
  }
}

void PlateReader::readPlate(std::size_t index) {
  C3dPlate plate;
  plate.name = "plate_" + std::to_string(index + 1);
  plate.type = index < types_.size() ? static_cast<int>(toInteger(types_[index])) : 0;
  const PlateType* const type = findType(plate.type);
  PlateGeometry geometry;
  // Every plate claims its channels, so that those of a refused one are not taken for EMG.
  const std::string channel_fault = claimChannels(index, type);
  const std::string geometry_fault = readGeometry(index, plate, geometry);
  plate.refusal = type == nullptr           ? describeUnsupportedType(plate.type)
                  : !channel_fault.empty()  ? channel_fault
                  : !geometry_fault.empty() ? geometry_fault
                                            : readCalibration(index, plate.type, geometry);
  if (plate.refusal.empty()) {
    findUnits(plate, *type, geometry);
    ExternalForce force = calcForce(*type, geometry);
    force.name = plate.name;
    turnToSubject(geometry.R_GP, force);
    result_.forces.push_back(std::move(force));
  } else {
    warnings_.push_back("forces of " + plate.name + " were not read: " + plate.refusal);
  }
  result_.plates.push_back(std::move(plate));
}

std::string PlateReader::claimChannels(std::size_t index, const PlateType* type) {
  columns_.clear();
  std::string fault;
  const std::size_t count = type == nullptr ? channel_stride_ : type->channel_count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = index * channel_stride_ + i;
    const double stated = i < channel_stride_ && at < channels_.size() ? channels_[at] : 0;
    const Eigen::Index column = toInteger(stated) - 1;
    if (column >= channelCount()) {
      fault = "its channel " + formatNumber(stated) + " is not in the file";
    } else if (column >= 0 && result_.plate_channels[static_cast<std::size_t>(column)]) {
      fault = "its channel " + formatNumber(stated) + " belongs to another plate";
    } else if (column >= 0) {
      result_.plate_channels[static_cast<std::size_t>(column)] = true;
    }
    columns_.push_back(column >= channelCount() ? -1 : std::max<Eigen::Index>(column, -1));
  }
  if (type != nullptr && fault.empty()) {
    for (const std::size_t i : type->normal_channels) {
      if (columns_[i] < 0) {
        fault = "FORCE_PLATFORM:CHANNEL names no channel of its vertical force";
      }
    }
    const auto named = std::count_if(
        columns_.begin(), columns_.end(), [](Eigen::Index column) { return column >= 0; });
    if (fault.empty() && named < kLeastChannels) {
      fault = "FORCE_PLATFORM:CHANNEL names only " + std::to_string(named) + " of its channels";
    }
  }
  return fault;
}

std::string PlateReader::readGeometry(std::size_t index,
                                      C3dPlate& plate,
                                      PlateGeometry& geometry) const {
  if (corners_.size() < 12 * (index + 1)) {
    return "FORCE_PLATFORM:CORNERS does not state where it lies";
  }
  plate.corners = Eigen::Map<const Eigen::Matrix<double, 3, 4>>(corners_.data() + 12 * index) *
                  input_.metres_per_unit;
  const Eigen::Vector3d x = plate.corners.col(0) - plate.corners.col(1);
  const Eigen::Vector3d y = plate.corners.col(0) - plate.corners.col(3);
  const bool is_finite = plate.corners.allFinite();
  if (!is_finite || plate.corners.cwiseAbs().maxCoeff() > kFarthestCorner ||
      x.norm() < kShortestEdge || x.normalized().cross(y).norm() < kShortestEdge) {
    if (!is_finite) {
      plate.corners.setZero();
    }
    return "its corners do not form a rectangle";
  }
  const Eigen::Vector3d z_axis = x.cross(y).normalized();
  geometry.R_GP << x.normalized(), z_axis.cross(x.normalized()), z_axis;
  geometry.p_GC = plate.corners.rowwise().mean();
  geometry.origin.setZero();
  if (origins_.size() >= 3 * (index + 1)) {
    geometry.origin =
        Eigen::Map<const Eigen::Vector3d>(origins_.data() + 3 * index) * input_.metres_per_unit;
  }
  if (!geometry.origin.allFinite() || geometry.origin.norm() > kFarthestCorner) {
    return "its origin is not a position";
  }
  // The sensors lie below the surface, and the plate's z axis points down; many files state the
  // vector the other way round.
  if (geometry.origin.z() > 0) {
    geometry.origin = -geometry.origin;
  }
  return "";
}

std::string PlateReader::readCalibration(std::size_t index,
                                         int type,
                                         PlateGeometry& geometry) const {
  if (type != 4) {
    return "";
  }
  if (matrices_.size() < 36 * (index + 1)) {
    return "it is of type 4 and the file has no FORCE_PLATFORM:CAL_MATRIX for it";
  }
  geometry.calibration =
      Eigen::Map<const Eigen::Matrix<double, 6, 6>>(matrices_.data() + 36 * index);
  geometry.calibration.bottomRows<3>() *= input_.metres_per_unit;
  return geometry.calibration.allFinite() ? "" : "its calibration matrix is not finite";
}

void PlateReader::findUnits(const C3dPlate& plate, const PlateType& type, PlateGeometry& geometry) {
  geometry.units.fill(1.0);
  for (std::size_t i = 0; i < type.channel_count; ++i) {
    const Quantity quantity = type.quantities[i];
    if (columns_[i] < 0 || quantity == Quantity::kRaw) {
      continue;
    }
    const std::string& stated = input_.channel_units[static_cast<std::size_t>(columns_[i])];
    const std::optional<double> unit = findUnit(quantity, stated);
    geometry.units[i] = unit ? *unit : quantity == Quantity::kForce ? 1.0 : input_.metres_per_unit;
    if (!unit && !stated.empty()) {
      warnings_.push_back("channel " + std::to_string(columns_[i] + 1) + " of " + plate.name +
                          " is in '" + stated + "'; it was taken as N, or N times the length " +
                          "unit of the points");
    }
  }
}

ExternalForce PlateReader::calcForce(const PlateType& type, const PlateGeometry& geometry) {
  const Eigen::Index rows = analog_.rows();
  ExternalForce result;
  result.force.resize(3, rows);
  result.point.resize(3, rows);
  result.torque.resize(3, rows);
  Channels channels = {};
  int lost = 0;
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < type.channel_count; ++i) {
      channels[i] = columns_[i] < 0 ? 0.0 : analog_(row, columns_[i]) * geometry.units[i];
    }
    Wrench wrench = type.calc(geometry, channels);
    if (!wrench.force.allFinite() || !wrench.moment.allFinite()) {
      wrench = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
      ++lost;
    }
    const Eigen::Vector3d& f = wrench.force;
    const Eigen::Vector3d& m = wrench.moment;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    if (std::abs(f.z()) >= kLeastNormalForce) {
      p = Eigen::Vector3d(-m.y() / f.z(), m.x() / f.z(), 0);
    }
    const double free_moment = m.z() - p.x() * f.y() + p.y() * f.x();
    result.force.col(row) = geometry.R_GP * f;
    result.point.col(row) = geometry.R_GP * p + geometry.p_GC;
    result.torque.col(row) = geometry.R_GP.col(2) * free_moment;
  }
  if (lost > 0) {
    warnings_.push_back("plate channels are not finite in " + std::to_string(lost) +
                        " samples; their forces were set to zero");
  }
  return result;
}

// By the format's conventions the rotated force acts on the subject. Not all writers keep them, and
// no floor pulls: a median load that points down shows the other sign.
void PlateReader::turnToSubject(const Eigen::Matrix3d& R_GP, ExternalForce& force) {
  Eigen::Vector3d up = input_.up;
  if (up.isZero()) {
    Eigen::Index axis = 0;
    R_GP.col(2).cwiseAbs().maxCoeff(&axis);
    up = Eigen::Vector3d::Unit(axis);
  }
  std::vector<double> loads;
  for (Eigen::Index row = 0; row < force.force.cols(); ++row) {
    const double load = up.dot(force.force.col(row));
    if (std::abs(load) > kSurelyLoaded) {
      loads.push_back(load);
    }
  }
  if (loads.empty()) {
    return;
  }
  const auto middle = loads.begin() + static_cast<std::ptrdiff_t>(loads.size() / 2);
  std::nth_element(loads.begin(), middle, loads.end());
  if (*middle < 0) {
    force.force = -force.force;
    force.torque = -force.torque;
    warnings_.push_back("under load the force of " + force.name +
                        " pointed down; force and moment were turned around");
  }
}

}  // namespace

C3dPlates readC3dPlates(const C3dParameters& parameters,
                        RowMatrix& analog,
                        const C3dPlateInput& input,
                        std::vector<std::string>& warnings) {
  return PlateReader(parameters, analog, input, warnings).read();
}

}  // namespace gaitmill
