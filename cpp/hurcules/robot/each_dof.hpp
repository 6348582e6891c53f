// Which joints a coordinate moves: its own, and those that follow it.
#pragma once

#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

template <class Act>
void Robot::each_dof(Index i, Act&& act) const {
  for (const DrivenJoint& joint : coordinates_[static_cast<std::size_t>(i)].joints)
    act(joint.dof, joint.factor);
  for (Index f = 0; closures_ && f < closures_->size(); ++f)
    act(closures_->dof(f), closures_->share()(f, i));
}

}  // namespace hurcules
