#pragma once

#include <string>
#include <vector>

#include "core/data/ground_reaction.h"
#include "core/io/table_reader.h"

namespace gaitmill {

/// Tells on which body a family of columns acts, for instance {"ground_force_2", "calcn_l"}.
struct PlateAssignment {
  std::string family;  ///< as ExternalForce::name
  std::string body;
};

/// What becomes of a plate of which nobody says which foot stands on it.
enum class UnnamedPlates {
  kRefuse,
  kKeep,  ///< its body stays empty: contacts tell the feet
};

struct GrfOptions {
  /// Below this vertical force the plate counts as unloaded [N]. 0 takes every sample as it is.
  double threshold = 20.0;
  std::string right_body = "calcn_r";
  std::string left_body = "calcn_l";
  /// Needed for plates that are only numbered; where given, families that are not listed are left
  /// out.
  std::vector<PlateAssignment> plates;
  UnnamedPlates unnamed = UnnamedPlates::kRefuse;
};

/// Families of force columns in a table, as ExternalForce::name: the labels without the axis and
/// without the letter v, "ground_force_r" for ground_force_r_vx. Recognised (spec/formats.md 3.1):
///   [S_]ground_force_[S_]vx,vy,vz   S = r, l, right, left, a number, or nothing
///   with points  [S_]ground_force_[S_]px..  and torques  [S_]ground_torque_[S_]x..  or
///   [S_]ground_moment_[S_]mx.. or [S_]ground_force_[S_]mx..
///   f1_1,f1_2,f1_3 with p1_1.. and m1_1..
std::vector<std::string> findForceFamilies(const std::vector<std::string>& labels);

/// The feet that the families name, in the order of findForceFamilies; unknown for plates.
std::vector<Foot> findFamilyFeet(const std::vector<std::string>& labels);

/// Every family of a table as its columns stand: bodies empty, no unit judged, nothing zeroed.
/// Torques that are absent are zero, points that are absent are not numbers.
/// @throws Error kGrfColumns if there is no family
GroundReaction readForceColumns(const TableFile& file);

/// The forces that feet use, each with its body, checked and zero where the plate is unloaded.
/// Centres of pressure may be missing where the plate is unloaded. Where they are missing for at
/// most 20 ms at the edge of a contact, where force plates know them worst, the nearest one of the
/// same contact is taken, and a contact as short as that without any is none; both with a warning.
/// @param all   in ground axes, N, m and N.m on the subject; bodies are replaced
/// @param feet  one per force, as findFamilyFeet
/// @param file  to name lines and columns in messages, or null
/// @param warnings  gets sentences, or null
/// @throws Error as readGroundReaction
GroundReaction selectForces(GroundReaction all,
                            const std::vector<Foot>& feet,
                            const GrfOptions& options,
                            const TableFile* file,
                            std::vector<std::string>* warnings = nullptr);

/// Ground reactions out of a table: one ExternalForce per family that a foot uses, in the order of
/// the columns. Side r, R_ or no side at all is the right foot; l, L_ or the number 1 in front
/// ("1_ground_force_vx", beside an unnumbered family) is the left.
///
/// Where |vertical force| < threshold, force and torque become exactly zero; the point stays as the
/// file has it and means nothing. Torque columns may be absent (zero), points may not.
/// @throws Error kGrfColumns (no family, a family without point, numbered plates without
/// assignment, an assignment that names no family), kGrfValue (a force or, on a loaded plate, a
/// point that is not a number), kGrfUnits (the numbers cannot be N, m, N.m on the subject with Y
/// up: the vertical force points down, exceeds 100 kN, never reaches the threshold, points lie
/// beyond 50 m, torques exceed 500 N.m)
GroundReaction readGroundReaction(const TableFile& file, const GrfOptions& options = {});

}  // namespace gaitmill
