// Strategy: polygons that a hand can reckon; what does not change when the frame turns; energy
// against the work of lifting. Not tested: more points than there is room.
#include "hurcules/sim/stability.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "support/expect.hpp"

namespace {

using namespace hurcules;

constexpr double kG = 9.81;

// 2 m along x, 1 m along y, about the origin
void add_rectangle(SupportPolygon& polygon, const Matrix3& R = Matrix3::Identity()) {
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-0.5, 0.5}) polygon.add(R * Vector3(x, y, 0.0), 1.0);
  }
}

SupportPolygon::Body body(const Vector3& com, double mass = 10.0) {
  return {com, mass, Vector3(0.0, 0.0, -kG)};
}

TEST(SupportPolygon, MeasuresTheWayToTheNearestEdge) {
  SupportPolygon polygon;
  add_rectangle(polygon);
  polygon.add(Vector3(0.2, 0.1, 0.0), 1.0);  // inside: no corner
  const Stability stands = polygon.judge(body({0.3, 0.1, 0.8}));
  EXPECT_NEAR(stands.margin, 0.4, 1e-12);
  EXPECT_NEAR(stands.tip_angle, std::atan2(0.4, 0.8), 1e-12);
  const double lift = std::hypot(0.4, 0.8) - 0.8;
  EXPECT_NEAR(stands.energy, 10.0 * kG * lift, 1e-9);
}

TEST(SupportPolygon, IsNegativeBeyondAnEdge) {
  SupportPolygon polygon;
  add_rectangle(polygon);
  const Stability tips = polygon.judge(body({1.25, 0.0, 1.0}));
  EXPECT_NEAR(tips.margin, -0.25, 1e-12);
  EXPECT_NEAR(tips.tip_angle, -std::atan2(0.25, 1.0), 1e-12);
  EXPECT_LT(tips.energy, 0.0);
}

TEST(SupportPolygon, OnASlopeTheCentreOfMassFallsAlongGravity) {
  // the rectangle leans by 30 degrees, nose up; a body 1.2 m above its middle
  const double slope = M_PI / 6.0;
  const Matrix3 R = Eigen::AngleAxisd(-slope, Vector3::UnitY()).toRotationMatrix();
  SupportPolygon polygon;
  add_rectangle(polygon, R);
  const Stability stands = polygon.judge(body(R * Vector3(0.0, 0.0, 1.2)));
  // to the rear edge, level; it has the slope's angle less to go than on flat ground
  EXPECT_NEAR(stands.margin, std::cos(slope) - 1.2 * std::sin(slope), 1e-12);
  EXPECT_NEAR(stands.tip_angle, std::atan2(1.0, 1.2) - slope, 1e-12);
}

TEST(SupportPolygon, TipsOnASlopeWhereTheoryTipsIt) {
  // height h over half length l: tips backward at atan(l / h) and not before
  const double tipping = std::atan2(1.0, 1.6);
  for (const double off : {-0.01, 0.01}) {
    const Matrix3 R = Eigen::AngleAxisd(-tipping - off, Vector3::UnitY()).toRotationMatrix();
    SupportPolygon polygon;
    add_rectangle(polygon, R);
    const Stability stands = polygon.judge(body(R * Vector3(0.0, 0.0, 1.6)));
    EXPECT_NEAR(stands.tip_angle, -off, 1e-12);
    EXPECT_EQ(stands.margin > 0.0, off < 0.0);
  }
}

TEST(SupportPolygon, TheCentreOfPressureGoesWithTheForces) {
  SupportPolygon polygon;
  polygon.add(Vector3(-1.0, -0.5, 0.0), 1.0);
  polygon.add(Vector3(-1.0, 0.5, 0.0), 1.0);
  polygon.add(Vector3(1.0, -0.5, 0.0), 3.0);
  polygon.add(Vector3(1.0, 0.5, 0.0), 3.0);
  // at x = 0.5: half a metre to the front, and as much to each side
  EXPECT_NEAR(polygon.judge(body({0.0, 0.0, 1.0})).pressure_margin, 0.5, 1e-12);
}

TEST(SupportPolygon, ALineAndAPointHaveNoInside) {
  SupportPolygon polygon;
  polygon.add(Vector3(0.0, 0.0, 0.0), 1.0);
  EXPECT_NEAR(polygon.judge(body({0.3, 0.4, 0.5})).margin, -0.5, 1e-12);
  EXPECT_NEAR(polygon.judge(body({0.3, 0.4, 0.5})).tip_angle, -M_PI / 4.0, 1e-12);
  for (const double x : {1.0, 2.0, 0.5}) polygon.add(Vector3(x, 0.0, 0.0), 1.0);
  const Stability line = polygon.judge(body({0.7, -0.2, 1.0}));
  EXPECT_NEAR(line.margin, -0.2, 1e-12);
  EXPECT_NEAR(line.tip_angle, -std::atan2(0.2, 1.0), 1e-12);
}

TEST(SupportPolygon, DoesNotDependOnTheFrame) {
  // everything turned together, gravity too, gives the same figures
  const Matrix3 R = (Eigen::AngleAxisd(0.7, Vector3(1.0, -2.0, 0.5).normalized()) *
                     Eigen::AngleAxisd(2.9, Vector3::UnitX()))
                        .toRotationMatrix();
  SupportPolygon plain, turned;
  const Vector3 corners[] = {{0.0, 0.0, 0.0}, {1.0, 0.1, 0.2}, {0.8, 0.9, -0.1}, {-0.2, 0.7, 0.1}};
  for (const Vector3& corner : corners) {
    plain.add(corner, corner.x() + 1.0);
    turned.add(R * corner, corner.x() + 1.0);
  }
  const Vector3 com(0.4, 0.4, 0.9), gravity(0.1, -0.2, -kG);
  const Stability a = plain.judge({com, 3.0, gravity});
  const Stability b = turned.judge({R * com, 3.0, R * gravity});
  EXPECT_NEAR(a.margin, b.margin, 1e-12);
  EXPECT_NEAR(a.pressure_margin, b.pressure_margin, 1e-12);
  EXPECT_NEAR(a.tip_angle, b.tip_angle, 1e-12);
  EXPECT_NEAR(a.energy, b.energy, 1e-9);
  EXPECT_GT(a.margin, 0.1);
}

TEST(SupportPolygon, AnInclinedEdgeNeedsLessWork) {
  // the edge along x rises by 45 degrees: the body lifts by cos 45 of what it turns
  SupportPolygon polygon;
  polygon.add(Vector3(-10.0, 0.0, -10.0), 1.0);
  polygon.add(Vector3(10.0, 0.0, 10.0), 1.0);
  polygon.add(Vector3(0.0, 50.0, 0.0), 1.0);
  const Vector3 normal = Vector3(-1.0, 0.0, 1.0).normalized();
  const Stability stands = polygon.judge(body(Vector3(0.0, 0.3, 0.0) + 0.4 * normal, 1.0));
  EXPECT_NEAR(stands.energy, kG * (0.5 - 0.4) * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(stands.tip_angle, std::atan2(0.3, 0.4), 1e-12);
}

}  // namespace
