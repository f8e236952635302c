#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/model_spec.h"

namespace gaitmill {

/// Reads a model document of version 20302 to 40600: bodies, joints, coordinates, couplers,
/// markers, muscles (Millard2012EquilibriumMuscle, Thelen2003Muscle, Schutte1993Muscle_Deprecated)
/// with fixed, conditional and moving path points over cylinders, spheres and ellipsoids, ideal
/// actuators, passive forces and muscle groups, with the inherited defaults, sockets and older
/// layouts of spec/model.md. SI units and radians, full precision of the text (OpenSim rounds
/// offsets and inertias of documents below 30505 to six digits; this reader does not).
///
/// What would change the mechanics but cannot be simulated is refused: other types of muscles,
/// joints and path points, wrap tori, further forces and constraints, prescribed coordinates. The
/// error kModelUnsupported names all of them, each in a line "line N: element: reason" of its
/// message, as far as its room allows, and every type at least once. Two things are left out with a
/// warning: forces that the document itself switches off, and contact with the floor, whose place
/// the measured ground reaction takes. Of the geometry the visible meshes of bodies are read, as
/// names of files and scale factors; other shapes, colours, ground's geometry, probes and
/// controllers are ignored.
///
/// An inertia that no body can have is raised to the nearest that one can, with a warning; so are
/// ball and free joints taken for what turns by the same angles. A custom joint all of whose
/// coordinates follow one other coordinate by curves is read as one coordinate equal to that, with
/// the curves on its axes.
///
/// @param file_name  for error messages only; nothing is opened
/// @param warnings   if given, one sentence per thing left out is appended
/// Documents beyond 16 MiB, sets of more than 2000 objects and more than 2000 wraps are refused; of
/// the warnings the first 100 are kept.
/// @throws Error kModelXml, kModelVersion, kModelElement, kModelValue, kModelReference,
/// kModelDuplicateName, kModelTopology, kModelUnsupported, kMuscleParameter, kFileEmpty,
/// kFileNotTheData, kFileTooLarge; all with line and column
ModelSpec readOsim(std::string_view bytes,
                   const std::string& file_name,
                   std::vector<std::string>* warnings = nullptr);

/// Markers of a marker-set document (root child <MarkerSet>) for the bodies of `spec`.
/// @throws Error as readOsim
std::vector<MarkerSpec> readMarkerSet(std::string_view bytes,
                                      const std::string& file_name,
                                      const ModelSpec& spec);

}  // namespace gaitmill
