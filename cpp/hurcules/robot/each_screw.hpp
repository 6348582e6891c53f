// Which coordinates a joint follows, and by which screws coordinates move bodies.
#pragma once

#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/screws.hpp"

namespace hurcules {

template <class Act>
void Screws::each_coordinate(const Driven& joint, Act&& act) const {
  if (joint.coordinate >= 0) return act(joint.coordinate, 1.0);
  for (Index i = 0; i < velocity_.size(); ++i) act(i, closures_->share()(joint.follower, i));
}

template <class Act>
void Screws::each_screw(Act&& act) const {
  for (const Driven& joint : driven_)
    each_coordinate(joint, [&](Index i, double share) { act(i, joint.body, share * joint.screw); });
  if (support_ < 0) return;
  for (const Index j : above(support_))
    each_coordinate(driven(j),
                    [&](Index i, double share) { act(i, root_, -share * driven(j).screw); });
}

}  // namespace hurcules
