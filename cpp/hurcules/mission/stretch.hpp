// The stretch of the rescue robot [T §4.4]: both lower arms reach forward on one button, all else
// stays as it was.
//
//   joint < hpos (6) < hpitch (2) < pel (1) < gaze (2),   rho = 0.1, K = 5 1/s
// First the hip meets its limit and the knees take over, then the shoulders meet theirs and the hip
// is free again: the pelvis gives way by 0.40 m; hands, pitch and gaze keep their references.
#pragma once

#include "hurcules/control/tasks.hpp"
#include "hurcules/mission/mission_simulation.hpp"
#include "hurcules/mission/stretch_figures.hpp"

namespace hurcules {

class Stretch final : public Mission {
 public:
  // for a controller of make_controller, or a clone of one
  Stretch(WholeBodyController& controller, double variation);
  [[nodiscard]] static MissionSetup setup_of();
  [[nodiscard]] static MissionTable table_of();
  // tasks, stack and channels of the stretch; the robot stands on the mission's support
  [[nodiscard]] static std::shared_ptr<WholeBodyController> make_controller(
      const Robot& robot, const MissionOptions& options);

  [[nodiscard]] std::string_view verdict() const override { return story_.verdict(); }
  [[nodiscard]] std::unique_ptr<Supervisor> clone(WholeBodyController& controller) const override;

 private:
  void begin(WholeBodyController& controller, const Robot& world) override;
  void entered(double time) override;
  void commanded(const WholeBodyController& controller, const TickReport& report) override;
  void measured(const TickReport& report) override;
  void save_memory(StateWriter& writer) const override;
  void restore_memory(StateReader& reader) override;

  StretchFigures story_;
  double stretched_ = 0.0;  // [m] forward command given so far, mean of both hands
};

}  // namespace hurcules
