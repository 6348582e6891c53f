// How far two bodies of a model are apart, and how that changes with the coordinates.
//
// It keeps mjData of its own, so that asking is const for the robot; it costs one more pass of
// kinematics and a distance for each pair of geoms that can touch anything.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

class GeomDistance {
 public:
  // pairs of names of bodies or geoms; a body stands for all of its geoms that can touch something.
  // Distances above `most` [m] are not looked for. Throws Error for a name that does not exist and
  // for a body without such geoms.
  GeomDistance(const Robot& robot, const std::vector<std::pair<std::string, std::string>>& pairs,
               double most);
  GeomDistance(const GeomDistance& other);

  [[nodiscard]] Index size() const { return static_cast<Index>(pairs_.size()); }
  // at the robot's configuration: distances [m] (k), negative in each other, `most` where farther;
  // gradient (k, n) [m/rad], zero there. The nearest geoms count; where they change, so does it.
  void measure(const Robot& robot, VectorRef distance, MatrixRef gradient);

 private:
  struct Pair {
    std::vector<int> first, second;  // geom ids
  };
  // nearest points of two geoms: from, to [m]
  using Points = std::array<double, 6>;
  struct Nearest {
    double distance = 0.0;
    int first = 0, second = 0;  // geoms
    Points points = {};
  };
  [[nodiscard]] Nearest nearest(const Pair& pair) const;
  // adds sign * direction' J of a point that is fixed in a geom's body
  void add(const Robot& robot, int geom, const double* point, const Vector3& direction,
           Eigen::Ref<Eigen::RowVectorXd> gradient);

  ModelPtr model_;
  std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
  std::vector<Pair> pairs_;
  double most_;
  Matrix linear_, angular_;  // scratch (3, n)
};

}  // namespace hurcules
