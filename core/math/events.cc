#include "core/math/events.h"

#include <cmath>

#include "core/base/error.h"

namespace gaitmill {
namespace {

constexpr int kPercentages = 101;

// Slack for times that hit a row up to round-off.
constexpr double kTimeTolerance = 1e-9;  // [s]

// Every stretch above the threshold, without further rules.
std::vector<Contact> findStretches(const std::vector<double>& time,
                                   const Eigen::Ref<const Eigen::VectorXd>& vertical,
                                   double threshold) {
  std::vector<Contact> stretches;
  bool loaded = false;
  for (Eigen::Index i = 0; i < vertical.size(); ++i) {
    const bool above = vertical(i) > threshold;
    if (above == loaded) continue;
    double crossing = time[static_cast<std::size_t>(i)];
    if (i > 0) {
      const double before = time[static_cast<std::size_t>(i - 1)];
      const double fraction = (threshold - vertical(i - 1)) / (vertical(i) - vertical(i - 1));
      crossing = before + fraction * (crossing - before);
    }
    if (above) {
      stretches.push_back({crossing, crossing, i > 0, false});
    } else {
      stretches.back().toe_off = crossing;
      stretches.back().has_toe_off = true;
    }
    loaded = above;
  }
  if (loaded) stretches.back().toe_off = time.back();
  return stretches;
}

// The duration that must be reached; a contact cut by the record's end gets the benefit of doubt.
bool isLongEnough(const Contact& contact, double duration) {
  const bool cut = !contact.has_strike || !contact.has_toe_off;
  return cut || contact.toe_off - contact.strike >= duration;
}

}  // namespace

std::vector<Contact> findContacts(const std::vector<double>& time,
                                  const Eigen::Ref<const Eigen::VectorXd>& vertical,
                                  const ContactOptions& options) {
  require(static_cast<Eigen::Index>(time.size()) == vertical.size(),
          ErrorCode::kTableShape,
          "contacts need one force per time");
  std::vector<Contact> merged;
  for (const Contact& stretch : findStretches(time, vertical, options.threshold)) {
    if (!isLongEnough(stretch, options.minimum_rise)) continue;
    if (!merged.empty() && stretch.strike - merged.back().toe_off < options.maximum_gap) {
      merged.back().toe_off = stretch.toe_off;
      merged.back().has_toe_off = stretch.has_toe_off;
    } else {
      merged.push_back(stretch);
    }
  }
  std::vector<Contact> contacts;
  for (const Contact& contact : merged) {
    if (isLongEnough(contact, options.minimum_duration)) contacts.push_back(contact);
  }
  return contacts;
}

TimeSeries normalizeToCycle(const TimeSeries& table, const GaitCycle& cycle) {
  const double duration = cycle.end - cycle.start;
  require(duration > 0, ErrorCode::kInputTimeRange, "gait cycle ends before it starts");
  require(table.rowCount() > 0, ErrorCode::kTableNoRows, "no rows to normalize");
  std::vector<double> percent(kPercentages);
  for (int i = 0; i < kPercentages; ++i) percent[static_cast<std::size_t>(i)] = i;
  TimeSeries normalized = makeTimeSeries(table.name, table.labels, std::move(percent));
  normalized.units = table.units;
  for (int i = 0; i < kPercentages; ++i) {
    const double inside = cycle.start + duration * i / (kPercentages - 1);
    for (const double t : {inside, inside + duration, inside - duration}) {
      if (t < table.time.front() - kTimeTolerance || t > table.time.back() + kTimeTolerance)
        continue;
      normalized.values.row(i) = table.interpolate(t).transpose();
      break;
    }
  }
  return normalized;
}

}  // namespace gaitmill
