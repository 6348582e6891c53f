// Seeded configurations and velocities of any robot.
#pragma once

#include <algorithm>
#include <random>

#include "hurcules/robot/robot.hpp"

namespace hurcules_test {

class RandomMotion {
 public:
  explicit RandomMotion(unsigned seed) : generator_(seed) {}

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(generator_);
  }
  hurcules::Vector vector(hurcules::Index size, double largest) {
    hurcules::Vector values(size);
    for (double& value : values) value = uniform(-largest, largest);
    return values;
  }
  // within the ranges, [-2, 2] where there are none
  hurcules::Vector configuration(const hurcules::Robot& robot) {
    hurcules::Vector q(robot.size());
    for (hurcules::Index i = 0; i < robot.size(); ++i)
      q[i] = uniform(std::max(robot.coordinates()[i].lower, -2.0),
                     std::min(robot.coordinates()[i].upper, 2.0));
    return q;
  }
  // the whole qpos: base and loose bodies anywhere too (quaternions come unnormalised)
  void move(hurcules::Robot& robot) {
    robot.set_qpos(robot.qpos() + vector(robot.qpos().size(), 0.4));
    robot.set_configuration(configuration(robot));
  }

 private:
  std::mt19937 generator_;
};

}  // namespace hurcules_test
