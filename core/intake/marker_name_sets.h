#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// One name of a marker set and what it stands for.
struct NamedMarker {
  std::string name;      ///< as the laboratory writes it: "R.ASIS"
  std::string landmark;  ///< of landmarks(); empty = known, but of no use here
};

/// The names that one laboratory or product uses.
struct MarkerNameSet {
  std::string name;         ///< "plug_in_gait"
  std::string description;  ///< with its source
  std::vector<NamedMarker> markers;
};

/// All sets that are known, sides written out. Where two sets fit equally well the first wins.
const std::vector<MarkerNameSet>& markerNameSets();

/// @returns nullptr if there is none of that name
const MarkerNameSet* findMarkerNameSet(const std::string& name);

}  // namespace gaitmill
