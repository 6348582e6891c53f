#include "hurcules/control/contact_forces.hpp"

#include <limits>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

const ContactTask* contact_of(const Task* task) {
  return dynamic_cast<const ContactTask*>(task);
}

bool has_contacts(const StackLevel& level) {
  for (const Task* task : level.tasks)
    if (contact_of(task)) return true;
  return false;
}

}  // namespace

ContactForces::ContactForces(const Robot& robot)
    : n_(robot.size()),
      floating_(robot.floating()),
      unit_(robot.weight() > 0.0 ? robot.weight() : 1.0),
      torques_("torque limits", robot) {
  torques_.set_weights(Vector::Constant(n_, 1.0 / unit_));
}

Stack ContactForces::completed(const Stack& stack) {
  contacts_.clear();
  size_ = 0;
  std::vector<StackLevel> levels;
  for (const StackLevel& level : stack.levels()) {
    if (!has_contacts(level)) {
      levels.push_back(level);
      continue;
    }
    require(contacts_.empty(),
            "a stack wants its contacts on one level; '" + level.name + "' is the second");
    for (const Task* task : level.tasks) {
      const ContactTask* const contact = contact_of(task);
      require(contact, "a level of contacts wants nothing beside them; '" + task->name() +
                           "' is no contact");
      contacts_.push_back(contact);
      size_ += contact->edges();
    }
    levels.push_back(StackLevel("torque limits", {&torques_}, 0.0));
    levels.push_back(level);
  }
  require(size_ > 0 || !floating_,
          "the root of the robot floats: a stack wants contacts (ContactTask) that carry it, by "
          "torques; by velocities a Robot that does not float stands on a body (stand_on)");
  lambda_ = Vector::Zero(size_);
  if (size_ == 0) return stack;
  least_.emplace(size_, n_);
  levels.push_back(StackLevel("least forces", {&*least_}));
  return Stack(std::move(levels));
}

void ContactForces::place(StackProblem& problem) {
  if (size_ == 0) return;
  require(problem.limits() != nullptr,
          "contacts want the limits of the coordinates in the stack: enforce_limits");
  problem.bounds().lower.tail(size_).setZero();
  problem.bounds().upper.tail(size_).setConstant(std::numeric_limits<double>::infinity());
  const std::vector<StackLevel>& levels = problem.stack().levels();
  places_.clear();
  for (std::size_t k = 0; k < levels.size(); ++k) {
    Index row = 0;
    for (const Task* task : levels[k].tasks) {
      if (const auto* limits = dynamic_cast<const TorqueLimits*>(task))
        places_.push_back({k, row, limits});
      row += task->rows();
    }
  }
}

void ContactForces::fill(Hierarchy& hierarchy) const {
  if (size_ == 0) return;
  for (const auto& [level, row, limits] : places_) {
    Index column = n_;
    for (const ContactTask* contact : contacts_) {
      hierarchy[level].A.block(row, column, n_, contact->edges()).noalias() =
          -unit_ * limits->weights().asDiagonal() * contact->efforts();
      column += contact->edges();
    }
  }
  hierarchy.back().A.rightCols(size_).setIdentity();
}

void ContactForces::read(const Vector& x) {
  lambda_ = unit_ * x.tail(size_);
}

void ContactForces::relieve(VectorRef torque) const {
  Index first = 0;
  for (const ContactTask* contact : contacts_) {
    torque.noalias() -= contact->efforts() * lambda_.segment(first, contact->edges());
    first += contact->edges();
  }
}

Vector3 ContactForces::force(const Task& task) const {
  Index first = 0;
  for (const ContactTask* contact : contacts_) {
    if (contact == &task) return contact->force(lambda_.segment(first, contact->edges()));
    first += contact->edges();
  }
  return Vector3::Zero();
}

}  // namespace hurcules
