#include "core/math/events.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

struct Force {
  std::vector<double> time;
  Eigen::VectorXd vertical;
};

Force readForce(const std::string& path, int header_lines, int column) {
  std::ifstream stream(path);
  std::string line;
  for (int i = 0; i < header_lines; ++i) std::getline(stream, line);
  Force force;
  std::vector<double> vertical;
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (double number = 0; cells >> number;) row.push_back(number);
    if (row.empty()) continue;
    force.time.push_back(row[0]);
    vertical.push_back(row[static_cast<std::size_t>(column)]);
  }
  force.vertical =
      Eigen::Map<Eigen::VectorXd>(vertical.data(), static_cast<Eigen::Index>(vertical.size()));
  return force;
}

using PublishedContacts = SharedDataTest;

// spec/signal.md 7.1: threshold 5 N on the published walking forces.
TEST_F(PublishedContacts, OfTheWalkingTrial) {
  const ContactOptions options{5, 0.3, 0.05, 0.025};
  const Force right = readForce(shared("data/walk/grf_walk.mot"), 7, 2);
  const auto contacts = findContacts(right.time, right.vertical, options);
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_NEAR(contacts[0].strike, 0.248, tol(5e-4));
  EXPECT_NEAR(contacts[0].toe_off, 1.047, tol(5e-4));
  EXPECT_NEAR(contacts[1].strike, 1.3925, tol(5e-4));
  EXPECT_NEAR(contacts[1].toe_off, 2.1915, tol(5e-4));
  const Force left = readForce(shared("data/walk/grf_walk.mot"), 7, 11);
  const auto other = findContacts(left.time, left.vertical, options);
  ASSERT_EQ(other.size(), 1u);
  EXPECT_NEAR(other[0].strike, 0.817, tol(5e-4));
  EXPECT_NEAR(other[0].toe_off, 1.613, tol(5e-4));
}

// Forces set to zero below 10 N at 1000 Hz: one sample on either side of the printed instants.
TEST_F(PublishedContacts, OfTheRunningTrial) {
  const Force right = readForce(shared("data/run/paper_subject01/grf_run.mot"), 6, 2);
  const auto contacts = findContacts(right.time, right.vertical, {5, 0.1, 0.05, 0.025});
  ASSERT_GE(contacts.size(), 3u);
  EXPECT_NEAR(contacts[1].strike, 0.863, tol(1e-3));
  EXPECT_NEAR(contacts[1].toe_off, 1.112, tol(1e-3));
  EXPECT_NEAR(contacts[2].strike, 1.547, tol(1e-3));
  EXPECT_NEAR(contacts[2].toe_off, 1.805, tol(1e-3));
}

Force makeContacts(const std::vector<std::pair<double, double>>& loaded) {
  Force force;
  force.vertical = Eigen::VectorXd::Zero(2001);
  for (int i = 0; i <= 2000; ++i) {
    const double t = i * 1e-3;
    force.time.push_back(t);
    for (const auto& [start, end] : loaded) {
      if (t > start && t < end) force.vertical(i) = 800;
    }
  }
  return force;
}

TEST(Contacts, GapsAreMergedAndShortTouchesDropped) {
  const Force force = makeContacts({{0.3, 0.5}, {0.53, 0.9}, {1.2, 1.25}, {1.5, 1.51}});
  const auto contacts = findContacts(force.time, force.vertical);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0].strike, 0.3, tol(1e-3));
  EXPECT_NEAR(contacts[0].toe_off, 0.9, tol(1e-3));
}

TEST(Contacts, CutByTheRecordSaySo) {
  const Force force = makeContacts({{-1, 0.05}, {1.9, 3}});
  const auto contacts = findContacts(force.time, force.vertical);
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_FALSE(contacts[0].has_strike);
  EXPECT_TRUE(contacts[0].has_toe_off);
  EXPECT_TRUE(contacts[1].has_strike);
  EXPECT_FALSE(contacts[1].has_toe_off);
}

// The published walking window: 25 % to 125 % of a cycle becomes 0..100 %.
TEST(GaitCycle, RowsBeyondTheCycleFillItsBeginning) {
  TimeSeries table = makeTimeSeries("t", {"a"}, {});
  for (int i = 25; i <= 125; ++i) table.time.push_back(0.248 + 1.1445 * i / 100);
  table.values.resize(101, 1);
  for (int i = 0; i <= 100; ++i) table.values(i, 0) = 25 + i;
  const TimeSeries cycle = normalizeToCycle(table, {0.248, 0.248 + 1.1445});
  ASSERT_EQ(cycle.rowCount(), 101);
  EXPECT_NEAR(cycle.values(0, 0), 100, tol(1e-9));  // 0 % is inside only as 100 %
  EXPECT_NEAR(cycle.values(10, 0), 110, tol(1e-9));
  EXPECT_NEAR(cycle.values(25, 0), 25, tol(1e-9));
  EXPECT_NEAR(cycle.values(100, 0), 100, tol(1e-9));
}

TEST(GaitCycle, WhatNobodyMeasuredStaysEmpty) {
  TimeSeries table = makeTimeSeries("t", {"a"}, {0.5, 0.75});
  table.values << 1, 2;
  const TimeSeries cycle = normalizeToCycle(table, {0, 1});
  EXPECT_TRUE(std::isnan(cycle.values(49, 0)));
  EXPECT_EQ(cycle.values(50, 0), 1);
  EXPECT_THROW(normalizeToCycle(table, {1, 1}), Error);
}

}  // namespace
}  // namespace gaitmill
