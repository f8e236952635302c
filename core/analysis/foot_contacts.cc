#include "core/analysis/foot_contacts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// A foot is 0.3 m long and its markers sit at both ends, so that the centre of pressure of its own
// foot lies within some 0.1 m of one of them, and the other foot a step away.
constexpr double kLargestDistance = 0.25;  // [m]
constexpr double kLeastDifference = 0.05;  // [m]
constexpr int kSamplesPerContact = 50;

/// "lab:R.Heel_2" -> "RHEEL2"
std::string normalize(const std::string& marker) {
  std::string letters;
  for (const char c : marker.substr(marker.rfind(':') + 1)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      letters += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  return letters;
}

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

bool namesPartOfAFoot(std::string_view letters) {
  constexpr std::array<std::string_view, 9> kParts = {
      "HEE", "CAL", "TOE", "MT", "ANK", "MAL", "LMAL", "MMAL", "FOOT"};
  return std::any_of(kParts.begin(), kParts.end(), [&](std::string_view part) {
    return startsWith(letters, part);
  });
}

Foot readSide(char letter) {
  return letter == 'R' ? Foot::kRight : letter == 'L' ? Foot::kLeft : Foot::kUnknown;
}

/// Markers of both feet, as positions in the list of markers.
struct FootMarkers {
  std::vector<int> right;
  std::vector<int> left;
};

FootMarkers findFootMarkers(const MarkerTrajectories& markers) {
  FootMarkers found;
  for (int i = 0; i < markers.markerCount(); ++i) {
    const Foot foot = findFootOfMarker(markers.names[static_cast<std::size_t>(i)]);
    if (foot != Foot::kUnknown) {
      (foot == Foot::kRight ? found.right : found.left).push_back(i);
    }
  }
  return found;
}

/// Horizontal distance of a point to the nearest of some markers [m]; infinite if none is seen.
double calcDistance(const Eigen::Vector3d& point,
                    const MarkerTrajectories& markers,
                    int frame,
                    const std::vector<int>& candidates) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const int marker : candidates) {
    if (!markers.isMissing(frame, marker)) {
      const Eigen::Vector3d offset = markers.position(frame, marker) - point;
      nearest = std::min(nearest, std::hypot(offset.x(), offset.z()));
    }
  }
  return nearest;
}

/// The frame nearest to a time that the markers cover, or -1.
int findFrame(const MarkerTrajectories& markers, double time) {
  const std::vector<double>& times = markers.time;
  if (times.empty() || time < times.front() || time > times.back()) {
    return -1;
  }
  const auto above = std::lower_bound(times.begin(), times.end(), time);
  const auto frame = static_cast<int>(above - times.begin());
  return frame > 0 && time - *(above - 1) < *above - time ? frame - 1 : frame;
}

/// Sums the distances of both feet over the samples of one contact.
class FootSearch {
 public:
  FootSearch(const GroundReaction& reaction, const MarkerTrajectories& markers)
      : reaction_(reaction), markers_(markers), feet_(findFootMarkers(markers)) {}

  Foot find(const ExternalForce& force, const Contact& contact) const {
    double right = 0;
    double left = 0;
    int samples = 0;
    for (int i = 1; i < kSamplesPerContact; ++i) {
      const double share = static_cast<double>(i) / kSamplesPerContact;
      const double time = contact.strike + share * (contact.toe_off - contact.strike);
      const int frame = findFrame(markers_, time);
      const Eigen::Index row = findRow(time);
      if (frame < 0 || force.force(1, row) <= 0 || !force.point.col(row).allFinite()) {
        continue;
      }
      right += calcDistance(force.point.col(row), markers_, frame, feet_.right);
      left += calcDistance(force.point.col(row), markers_, frame, feet_.left);
      ++samples;
    }
    return samples == 0 ? Foot::kUnknown : judge(right / samples, left / samples);
  }

 private:
  static Foot judge(double right, double left) {
    const bool near = std::min(right, left) <= kLargestDistance;
    const bool clear = std::abs(right - left) >= kLeastDifference;
    if (!near || !clear) {
      return Foot::kUnknown;
    }
    return right < left ? Foot::kRight : Foot::kLeft;
  }

  Eigen::Index findRow(double time) const {
    const std::vector<double>& times = reaction_.time;
    const auto above = std::lower_bound(times.begin(), times.end() - 1, time);
    return above - times.begin();
  }

  const GroundReaction& reaction_;
  const MarkerTrajectories& markers_;
  FootMarkers feet_;
};

}  // namespace

Foot findFootOfMarker(const std::string& marker) {
  const std::string letters = normalize(marker);
  if (letters.size() < 3) {
    return Foot::kUnknown;
  }
  const std::string_view all(letters);
  if (readSide(all.front()) != Foot::kUnknown && namesPartOfAFoot(all.substr(1))) {
    return readSide(all.front());
  }
  return namesPartOfAFoot(all) ? readSide(all.back()) : Foot::kUnknown;
}

std::vector<FootContact> findFootContacts(const GroundReaction& reaction,
                                          const std::vector<Foot>& feet,
                                          const MarkerTrajectories& markers) {
  check(feet.size() == reaction.forces.size(), "every force needs its foot, known or not");
  const FootSearch search(reaction, markers);
  std::vector<FootContact> contacts;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const ExternalForce& force = reaction.forces[i];
    for (const Contact& contact : findContacts(reaction.time, force.force.row(1).transpose())) {
      const Foot foot = feet[i] == Foot::kUnknown ? search.find(force, contact) : feet[i];
      contacts.push_back({force.name, foot, contact});
    }
  }
  std::stable_sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) {
    return a.contact.strike < b.contact.strike;
  });
  return contacts;
}

std::vector<GaitEvent> findGaitEvents(const std::vector<FootContact>& contacts) {
  // Whether the same foot stands on another plate at that time.
  const auto is_standing = [&](const FootContact& except, double time) {
    return std::any_of(contacts.begin(), contacts.end(), [&](const FootContact& other) {
      return &other != &except && other.foot == except.foot && other.contact.strike < time &&
             time < other.contact.toe_off;
    });
  };
  std::vector<GaitEvent> events;
  for (const FootContact& one : contacts) {
    if (one.foot == Foot::kUnknown) {
      continue;
    }
    if (one.contact.has_strike && !is_standing(one, one.contact.strike)) {
      events.push_back({GaitEvent::Kind::kFootStrike, one.foot, one.contact.strike});
    }
    if (one.contact.has_toe_off && !is_standing(one, one.contact.toe_off)) {
      events.push_back({GaitEvent::Kind::kToeOff, one.foot, one.contact.toe_off});
    }
  }
  std::stable_sort(events.begin(), events.end(), [](const GaitEvent& a, const GaitEvent& b) {
    return a.time < b.time;
  });
  return events;
}

std::vector<GaitCycle> findGaitCycles(const std::vector<GaitEvent>& events, Foot foot) {
  std::vector<GaitCycle> cycles;
  const GaitEvent* strike = nullptr;
  int toe_offs = 0;
  for (const GaitEvent& event : events) {
    if (event.foot != foot) {
      continue;
    }
    if (event.kind == GaitEvent::Kind::kToeOff) {
      ++toe_offs;
      continue;
    }
    if (strike != nullptr && toe_offs == 1) {
      cycles.push_back({strike->time, event.time});
    }
    strike = &event;
    toe_offs = 0;
  }
  return cycles;
}

}  // namespace gaitmill
