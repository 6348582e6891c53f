// Postures that meet all tasks of a stack at once, where a controller that sets out from where the
// robot stands ends short of them.
//
// The first descent begins at the present posture; where limits or singularities end it, others begin
// at random ones, each farther from the present one than the last. What a robot does not reach from
// here in one go (the target wants an elbow or a wrist turned the other way) it reaches by such a
// posture. Nothing is said of the way between the two.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hurcules/base/random.hpp"
#include "hurcules/control/velocity_controller.hpp"

namespace hurcules {

struct PostureSearchOptions {
  int starts = 32;          // descents at most
  std::uint64_t seed = 0;   // of the random postures; same arguments, same posture
  double tolerance = 1e-4;  // [m] or [rad] that a row of a task may lack
};

struct Posture {
  Vector configuration;  // (n), within the limits
  Vector qpos;           // (nq) the whole of it: joints that close loops may stand in two ways
  double error = 0.0;    // [m] or [rad] the largest that any row of a task lacks
  bool reached = false;  // no row lacks more than the tolerance
  int starts = 0;        // descents that began, and how many of them reached
  int reaching = 0;
};

class PostureSearch {
 public:
  // With a robot and tasks of its own, copies of these. Limits of the stack hold in each posture.
  // Throws Error without a task, for fewer than one start, and a tolerance that is not positive.
  PostureSearch(const Robot& robot, const Stack& stack, PostureSearchOptions options = {});
  // anew, from where this robot of the same model is, to where the tasks lead now
  void begin(const Robot& robot);
  // so many ticks of its descents further; false once it is over
  bool advance(int ticks);
  // Of the postures that meet all tasks the nearest to the first one; where there is none, the one
  // that lacks least in the first level, then in the second, and so on: the norm of its rows, in
  // steps of ten tolerances. Throws Error before `advance` has ended it.
  [[nodiscard]] Posture best() const;
  // [m] or [rad] the most that a level from `first` on lacks less there than at the first posture;
  // only up to the first level of all that lacks more, by ten tolerances
  [[nodiscard]] double nearer(std::size_t first) const;

 private:
  struct End {
    Posture posture;
    std::vector<double> lacks;  // of each level
  };
  [[nodiscard]] const End& best_end() const;
  [[nodiscard]] double step_of_lacks() const { return 10.0 * options_.tolerance; }
  void begin_descent();
  void tick();
  void measure();
  [[nodiscard]] bool gets_no_nearer();
  void end_descent();
  [[nodiscard]] Vector drawn();

  PostureSearchOptions options_;
  Robot robot_;
  std::vector<const Task*> originals_;
  std::vector<std::unique_ptr<Task>> tasks_;  // copies of them
  Stack stack_;                               // of the copies
  VelocityController controller_;
  Random random_;
  Vector present_, whole_;  // (n), (nq) where it began
  std::vector<End> ends_;
  std::vector<double> lacks_, nearest_;  // of each level; the least so far
  std::vector<double> present_lacks_;    // of each level, where it began
  double most_ = 0.0;                    // of any row
  int ticks_ = 0;                        // of this descent
  bool over_ = false;
};

// all of a search in one call
[[nodiscard]] Posture inverse_kinematics(const Robot& robot, const Stack& stack,
                                         const PostureSearchOptions& options = {});

}  // namespace hurcules
