// Strategy: the limits come from the robot, may be narrowed by name, never widened.
#include "hurcules/control/joint_limits.hpp"

#include <cmath>
#include <limits>

#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class JointLimitsOfTwin : public testing::Test {
 protected:
  Robot robot_{load_model_text(kTwin)};
  JointLimits limits_{"joint", robot_};
  const Index hip_ = robot_.coordinate("HIP"), knee_ = robot_.coordinate("KN");
};

TEST_F(JointLimitsOfTwin, AreThoseOfTheRobot) {
  EXPECT_EQ(limits_.lower()[hip_], -1.5);
  EXPECT_EQ(limits_.upper()[knee_], 1.0);
  EXPECT_EQ(limits_.upper()[robot_.coordinate("WST")], kInfinity);
  EXPECT_EQ(limits_.max_velocity()[knee_], 0.4);
  EXPECT_EQ(limits_.size(), 13);
}

TEST_F(JointLimitsOfTwin, KnowWhereTheCoordinatesAre) {
  const Vector q = Vector::LinSpaced(13, -0.5, 0.5);
  robot_.set_configuration(q);
  limits_.update(robot_);
  EXPECT_EQ(limits_.configuration(), q);
  const RateState state = limits_.state(hip_, 0.1);
  EXPECT_EQ(state.to_lower, -1.5 - q[hip_]);
  EXPECT_EQ(state.to_upper, 1.5 - q[hip_]);
  EXPECT_EQ(state.velocity, 0.1);
  Robot other(load_model_text(kPendulum));
  EXPECT_TRUE(contains(error_text([&] { limits_.update(other); }), "made for another robot"));
}

TEST_F(JointLimitsOfTwin, HoldAStepAtTheLimitAndLetItLeadBack) {
  robot_.set_configuration(Vector::Zero(13));
  limits_.update(robot_);
  EXPECT_EQ(limits_.held_step(hip_, 0.5), 0.5);
  EXPECT_EQ(limits_.held_step(hip_, 2.0), 1.5);
  EXPECT_EQ(limits_.held_step(hip_, -2.0), -1.5);
  limits_.set_range("HIP", 0.25, 1.0);  // it stands outside
  EXPECT_EQ(limits_.held_step(hip_, 0.1), 0.1);
  EXPECT_EQ(limits_.held_step(hip_, -0.1), 0.0);
}

TEST_F(JointLimitsOfTwin, BringTheirSpeedsToTheLimitsOfAController) {
  const RateLimits rates = limits_.rates(knee_, {.max_velocity = 9.0, .max_acceleration = 3.0});
  EXPECT_EQ(rates.max_velocity, 0.4);
  EXPECT_EQ(rates.max_acceleration, 3.0);
}

TEST_F(JointLimitsOfTwin, AModeNarrowsThemAndAResetBringsThemBack) {
  limits_.set_range("HIP", -1.0, 0.36);
  limits_.set_max_velocity("HIP", 0.25);
  EXPECT_EQ(limits_.upper()[hip_], 0.36);
  EXPECT_EQ(limits_.upper()[knee_], 1.0);
  EXPECT_EQ(limits_.max_velocity()[hip_], 0.25);
  limits_.reset_ranges();
  EXPECT_EQ(limits_.upper()[hip_], 1.5);
}

TEST_F(JointLimitsOfTwin, AreNeverWidened) {
  const std::string text = error_text([&] { limits_.set_range("HIP", -1.6, 0); });
  EXPECT_TRUE(contains(text, "'HIP' wants lower <= upper within -1.5")) << text;
  EXPECT_FALSE(error_text([&] { limits_.set_range("HIP", 0.2, 0.1); }).empty());
  EXPECT_FALSE(error_text([&] { limits_.set_range("HIP", std::nan(""), 0.1); }).empty());
  EXPECT_EQ(limits_.lower()[hip_], -1.5);
  const Vector zero = Vector::Zero(13), one = Vector::Ones(13), few = Vector::Zero(12);
  EXPECT_TRUE(contains(error_text([&] { limits_.set_interval(few, one); }), "'joint' want 13"));
  EXPECT_TRUE(contains(error_text([&] { limits_.set_interval(one, zero); }), "lower <= upper"));
  EXPECT_EQ(limits_.lower()[hip_], -1.5);
}

TEST_F(JointLimitsOfTwin, TheModeIsKeptInTheSnapshot) {
  limits_.set_range("HIP", -1.0, 0.36);
  limits_.set_max_velocity("HIP", 0.25);
  std::vector<double> state;
  StateWriter writer(state);
  limits_.save(writer);
  JointLimits other("joint", robot_);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_EQ(other.lower(), limits_.lower());
  EXPECT_EQ(other.upper(), limits_.upper());
  EXPECT_EQ(other.max_velocity(), limits_.max_velocity());
}

TEST_F(JointLimitsOfTwin, UnknownCoordinatesAndBadSpeedsAreErrors) {
  EXPECT_TRUE(contains(error_text([&] { limits_.set_range("HPI", 0, 1); }), "HIP, KN, WST"));
  EXPECT_TRUE(contains(error_text([&] { limits_.set_max_velocity("HIP", 0); }), "above 0"));
}

}  // namespace
