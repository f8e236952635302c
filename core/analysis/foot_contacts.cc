#include "core/analysis/foot_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kStep = 0.01;             // [s] between the samples that are looked at
constexpr double kLargestDistance = 0.25;  // [m] of a foot that may be meant at all
constexpr double kDistanceScale = 0.05;    // [m] that doubles as the least separation
constexpr double kSpeedScale = 1.0;        // [m/s] a swinging foot passes the pelvis at 1.3 to 4
constexpr double kSpeedSpan = 0.02;        // [s] to each side for a speed
// Half a foot's width, and the 5 cm by which loaded centres of pressure of good trials lie outside.
constexpr double kSole = 0.10;          // [m]
constexpr double kOutsideShare = 0.25;  // of the loaded samples
constexpr double kLoadedShare = 0.2;    // of the contact's peak force
// A centre of pressure under a foot: within its sole, and clearly further from the other one.
constexpr double kUnderFoot = 0.08;            // [m]
constexpr double kClearlyFurther = 0.03;       // [m]
constexpr double kLeastTimeOfFoot = 0.08;      // [s] under each foot of a plate that serves both
constexpr double kLeastRun = 0.045;            // [s] under one foot without interruption
constexpr double kLongestDoubleSupport = 0.4;  // [s]

/// What is seen at one instant of a contact; arrays hold right, left.
struct Sample {
  double time = 0;
  double vertical = 0;                            ///< [N]
  std::array<double, 2> distance = {kNaN, kNaN};  ///< of the centre of pressure to the foot [m]
  std::array<double, 2> speed = {kNaN, kNaN};     ///< of the foot against the pelvis, forward [m/s]
  bool is_between = false;  ///< the centre of pressure lies between the feet, under neither
};

constexpr std::array<Foot, 2> kFeet = {Foot::kRight, Foot::kLeft};

double findMedian(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }),
               values.end());
  if (values.empty()) {
    return kNaN;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The evidence about one foot over some samples.
struct Evidence {
  Foot foot = Foot::kUnknown;
  double confidence = 0;
  std::string reason;
};

std::string describe(const std::array<double, 2>& distance, const std::array<double, 2>& speed) {
  std::string text = "centre of pressure";
  const char* separator = " ";
  for (const std::size_t i : {0U, 1U}) {
    if (!std::isnan(distance[i])) {
      text +=
          separator + formatFixed(distance[i], 2) + " m from the " + footName(kFeet[i]) + " foot";
      if (!std::isnan(speed[i])) {
        text += " (" + formatFixed(speed[i], 1) + " m/s against the pelvis)";
      }
      separator = ", ";
    }
  }
  return text;
}

Evidence weigh(const std::array<double, 2>& distance, const std::array<double, 2>& speed) {
  if (std::isnan(distance[0]) && std::isnan(distance[1])) {
    return {Foot::kUnknown, 0, "no foot marker is seen"};
  }
  const bool left_is_nearer = std::isnan(distance[0]) || distance[1] < distance[0];
  const std::size_t near = left_is_nearer ? 1 : 0;
  const std::size_t far = 1 - near;
  // A foot that is not seen is somewhere else for all we know.
  const double other = std::isnan(distance[far]) ? distance[near] + 0.2 : distance[far];
  const double faster = speed[far] - speed[near];
  const double score =
      (other - distance[near]) / kDistanceScale + (std::isnan(faster) ? 0.0 : faster / kSpeedScale);
  const double plausibility = std::exp(-std::max(0.0, distance[near] - kSole) / 0.1);
  Evidence evidence;
  evidence.confidence = plausibility / (1 + std::exp(-score));
  evidence.reason = describe(distance, speed);
  if (distance[near] <= kLargestDistance && evidence.confidence >= kLeastConfidence) {
    evidence.foot = kFeet[near];
  }
  return evidence;
}

/// Looks at the contacts of one recording.
class FootSearch {
 public:
  FootSearch(const GroundReaction& reaction, const GaitMotion& motion)
      : reaction_(reaction), motion_(motion) {}

  std::vector<Sample> sample(const ExternalForce& force, const Contact& contact) const {
    std::vector<Sample> samples;
    const double duration = contact.toe_off - contact.strike;
    const int count = std::max(50, static_cast<int>(duration / kStep));
    for (int i = 1; i < count; ++i) {
      const double time = contact.strike + duration * i / count;
      const int frame = motion_.findFrame(time);
      const Eigen::Index row = findRow(time);
      if (frame < 0 || force.force(1, row) <= 0 || !force.point.col(row).allFinite()) {
        continue;
      }
      samples.push_back(look(time, force, row, frame));
    }
    return samples;
  }

 private:
  Sample look(double time, const ExternalForce& force, Eigen::Index row, int frame) const {
    Sample sample;
    sample.time = time;
    sample.vertical = force.force(1, row);
    for (const std::size_t i : {0U, 1U}) {
      const FootMotion& foot = motion_.foot(kFeet[i]);
      sample.distance[i] = foot.calcDistance(force.point.col(row), frame);
      sample.speed[i] = calcSpeed(foot, frame);
    }
    const auto [right, left] = sample.distance;
    const Eigen::Vector3d apart =
        0.5 * (motion_.right.heel.col(frame) + motion_.right.toe.col(frame) -
               motion_.left.heel.col(frame) - motion_.left.toe.col(frame));
    const double span = std::hypot(apart.x(), apart.z());
    sample.is_between = std::min(right, left) > kUnderFoot && std::abs(right - left) < 0.5 * span;
    return sample;
  }

  double calcSpeed(const FootMotion& foot, int frame) const {
    const auto last = static_cast<int>(motion_.time.size()) - 1;
    const double time = motion_.time[static_cast<std::size_t>(frame)];
    const auto lead = [&](int at) {
      const Eigen::Vector3d middle = 0.5 * (foot.heel.col(at) + foot.toe.col(at));
      return (middle - motion_.pelvis.col(at)).dot(motion_.forward);
    };
    const int before = std::max(0, std::min(frame - 1, motion_.findFrame(time - kSpeedSpan)));
    const int at_or_after = motion_.findFrame(time + kSpeedSpan);
    const int after = std::min(last, std::max(frame + 1, at_or_after));
    const double span = motion_.time[static_cast<std::size_t>(after)] -
                        motion_.time[static_cast<std::size_t>(before)];
    return span > 0 ? (lead(after) - lead(before)) / span : kNaN;
  }

  Eigen::Index findRow(double time) const {
    const std::vector<double>& times = reaction_.time;
    const auto above = std::lower_bound(times.begin(), times.end() - 1, time);
    return above - times.begin();
  }

  const GroundReaction& reaction_;
  const GaitMotion& motion_;
};

Evidence judge(const std::vector<Sample>& samples, const Contact& contact) {
  const double third = (contact.toe_off - contact.strike) / 3;
  std::array<std::vector<double>, 2> distance;
  std::array<std::vector<double>, 2> speed;
  for (const Sample& sample : samples) {
    if (sample.time < contact.strike + third || sample.time > contact.toe_off - third) {
      continue;
    }
    for (const std::size_t i : {0U, 1U}) {
      distance[i].push_back(sample.distance[i]);
      speed[i].push_back(sample.speed[i]);
    }
  }
  return weigh({findMedian(distance[0]), findMedian(distance[1])},
               {findMedian(speed[0]), findMedian(speed[1])});
}

/// The foot under which a centre of pressure lies for sure.
Foot findFootUnder(const Sample& sample) {
  const auto [right, left] = sample.distance;
  if (right <= kUnderFoot && !(left <= right + kClearlyFurther)) {
    return Foot::kRight;
  }
  if (left <= kUnderFoot && !(right <= left + kClearlyFurther)) {
    return Foot::kLeft;
  }
  return Foot::kUnknown;
}

/// Time that a plate spends under one foot without interruption.
struct Run {
  Foot foot = Foot::kUnknown;
  double start = 0;
  double end = 0;
};

std::vector<Run> findRuns(const std::vector<Sample>& samples) {
  std::vector<Run> runs;
  std::optional<Run> open;
  const auto close = [&] {
    if (open && open->end - open->start >= kLeastRun) {
      if (!runs.empty() && runs.back().foot == open->foot) {
        runs.back().end = open->end;
      } else {
        runs.push_back(*open);
      }
    }
    open.reset();
  };
  for (const Sample& sample : samples) {
    const Foot foot = findFootUnder(sample);
    if (open && open->foot == foot) {
      open->end = sample.time;
      continue;
    }
    close();
    if (foot != Foot::kUnknown) {
      open = Run{foot, sample.time, sample.time};
    }
  }
  close();
  return runs;
}

/// Whether the runs are those of a plate that serves both feet.
bool servesBothFeet(const std::vector<Run>& runs) {
  std::array<double, 2> total = {0, 0};
  for (const Run& run : runs) {
    total[run.foot == Foot::kLeft ? 1 : 0] += run.end - run.start;
  }
  return std::min(total[0], total[1]) >= kLeastTimeOfFoot;
}

bool liesBetweenFeet(const std::vector<Sample>& samples) {
  const auto between = std::count_if(
      samples.begin(), samples.end(), [](const Sample& sample) { return sample.is_between; });
  return 2 * static_cast<std::size_t>(between) > samples.size();
}

/// The event of that kind nearest to a time within a reach, else the time itself.
double findEvent(const std::vector<GaitEvent>& events,
                 GaitEvent::Kind kind,
                 Foot foot,
                 double low,
                 double high,
                 double otherwise) {
  for (const GaitEvent& event : events) {
    if (event.kind == kind && event.foot == foot && event.time > low && event.time < high) {
      return event.time;
    }
  }
  return otherwise;
}

void markOutside(const std::vector<Sample>& samples, FootContact& contact) {
  double peak = 0;
  for (const Sample& sample : samples) {
    peak = std::max(peak, sample.vertical);
  }
  int loaded = 0;
  int outside = 0;
  for (const Sample& sample : samples) {
    const double distance = sample.distance[contact.foot == Foot::kLeft ? 1 : 0];
    const bool inside_contact =
        sample.time >= contact.contact.strike && sample.time <= contact.contact.toe_off;
    if (inside_contact && sample.vertical > kLoadedShare * peak && !std::isnan(distance)) {
      ++loaded;
      outside += distance > kSole ? 1 : 0;
    }
  }
  contact.is_outside_sole = loaded > 0 && outside > kOutsideShare * loaded;
}

/// One contact of a plate as the contacts of its feet.
class ContactSplitter {
 public:
  ContactSplitter(const std::string& plate,
                  const Contact& contact,
                  const std::vector<Sample>& samples,
                  const std::vector<GaitEvent>& events)
      : plate_(plate), contact_(contact), samples_(samples), events_(events) {}

  std::vector<FootContact> split() const {
    const std::vector<Run> runs = findRuns(samples_);
    if (servesBothFeet(runs)) {
      return splitAt(runs);
    }
    FootContact whole{plate_, Foot::kUnknown, contact_};
    const Evidence evidence = judge(samples_, contact_);
    whole.foot = evidence.foot;
    whole.seen = evidence.foot;
    whole.confidence = evidence.confidence;
    whole.reason = evidence.reason;
    if (liesBetweenFeet(samples_)) {
      whole.foot = Foot::kUnknown;
      whole.is_shared = true;
      whole.reason += "; it lies between the feet";
    }
    return {whole};
  }

 private:
  std::vector<FootContact> splitAt(const std::vector<Run>& runs) const {
    std::vector<FootContact> parts;
    double start = contact_.strike;
    bool has_strike = contact_.has_strike;
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
      const Run& last = runs[i];
      const Run& next = runs[i + 1];
      const double both_from = std::clamp(findEvent(events_,
                                                    GaitEvent::Kind::kFootStrike,
                                                    next.foot,
                                                    next.start - kLongestDoubleSupport,
                                                    next.start,
                                                    last.end),
                                          last.start,
                                          last.end);
      const double both_to = std::clamp(findEvent(events_,
                                                  GaitEvent::Kind::kToeOff,
                                                  last.foot,
                                                  last.end,
                                                  last.end + kLongestDoubleSupport,
                                                  next.start),
                                        next.start,
                                        next.end);
      parts.push_back(makePart(last.foot, {start, both_from, has_strike, false}));
      FootContact both{plate_, Foot::kUnknown, {both_from, both_to, false, false}};
      both.is_shared = true;
      both.confidence = 1;
      both.reason = std::string("the centre of pressure moves from the ") + footName(last.foot) +
                    " to the " + footName(next.foot) + " foot";
      parts.push_back(both);
      start = both_to;
      has_strike = false;
    }
    parts.push_back(
        makePart(runs.back().foot, {start, contact_.toe_off, has_strike, contact_.has_toe_off}));
    return parts;
  }

  FootContact makePart(Foot foot, const Contact& contact) const {
    FootContact part{plate_, foot, contact};
    const Evidence evidence = judge(samples_, contact);
    part.seen = foot;
    part.confidence = evidence.foot == foot ? evidence.confidence : kLeastConfidence;
    part.reason = evidence.reason;
    return part;
  }

  const std::string& plate_;
  const Contact& contact_;
  const std::vector<Sample>& samples_;
  const std::vector<GaitEvent>& events_;
};

FootContact believe(const std::string& plate,
                    Foot named,
                    const Contact& contact,
                    const std::vector<Sample>& samples) {
  FootContact believed{plate, named, contact};
  const Evidence evidence = judge(samples, contact);
  believed.seen = evidence.foot;
  believed.reason = std::string("the columns or settings name the ") + footName(named) + " foot; " +
                    evidence.reason;
  const bool contradicted = evidence.foot == otherFoot(named);
  believed.confidence = contradicted                      ? 1 - evidence.confidence
                        : evidence.foot == Foot::kUnknown ? kLeastConfidence
                                                          : evidence.confidence;
  return believed;
}

void state(const std::vector<ContactStatement>& statements, std::vector<FootContact>& contacts) {
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const ContactStatement& statement = statements[i];
    const auto found =
        std::find_if(contacts.begin(), contacts.end(), [&](const FootContact& contact) {
          return contact.plate == statement.plate && contact.contact.strike <= statement.time &&
                 statement.time <= contact.contact.toe_off;
        });
    require(found != contacts.end(),
            ErrorCode::kSettingsValue,
            "'" + statement.plate + "' has no contact at " + formatFixed(statement.time, 3) + " s",
            {{}, 0, 0, "trial.contacts[" + std::to_string(i) + "]"});
    found->foot = statement.foot;
    found->is_stated = true;
    found->is_shared = false;
    found->is_foreign = statement.foot == Foot::kUnknown;
    found->confidence = 1;
    found->reason = "stated in the settings; " + found->reason;
  }
}

}  // namespace

std::vector<FootContact> findFootContacts(const GroundReaction& reaction,
                                          const std::vector<Foot>& named,
                                          const GaitMotion& motion,
                                          const std::vector<GaitEvent>& marker_events,
                                          const std::vector<ContactStatement>& statements) {
  check(named.size() == reaction.forces.size(), "every force needs its foot, known or not");
  const FootSearch search(reaction, motion);
  std::vector<FootContact> contacts;
  for (std::size_t i = 0; i < named.size(); ++i) {
    const ExternalForce& force = reaction.forces[i];
    for (const Contact& contact : findContacts(reaction.time, force.force.row(1).transpose())) {
      const std::vector<Sample> samples = search.sample(force, contact);
      std::vector<FootContact> found =
          named[i] == Foot::kUnknown
              ? ContactSplitter(force.name, contact, samples, marker_events).split()
              : std::vector<FootContact>{believe(force.name, named[i], contact, samples)};
      for (FootContact& one : found) {
        markOutside(samples, one);
        contacts.push_back(std::move(one));
      }
    }
  }
  state(statements, contacts);
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
    if (!one.isUsable() || one.is_partial || one.isContradicted()) {
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
