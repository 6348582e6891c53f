#include "hurcules/control/channel.hpp"

#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/tasks/force_task.hpp"

namespace hurcules {

namespace {

std::vector<std::string> usual_components(Index size) {
  static const std::vector<std::string> six = {"x", "y", "z", "rx", "ry", "rz"};
  if (size == 3 || size == 6) return {six.begin(), six.begin() + size};
  std::vector<std::string> numbers;
  for (Index i = 0; i < size; ++i) numbers.push_back(std::to_string(i));
  return numbers;
}

Vector spread_over(Vector scale, Index rows) {
  return scale.size() == 1 && rows != 1 ? Vector(Vector::Constant(rows, scale[0])) : scale;
}

Index numbers_of(ChannelKind kind, const Task& task) {
  return kind == ChannelKind::Target ? task.target_size() : task.rows();
}

bool leads_task(ChannelKind kind) {
  return kind == ChannelKind::Twist || kind == ChannelKind::Delta || kind == ChannelKind::Target ||
         kind == ChannelKind::Force;
}

void require_target(const std::string& name, ChannelKind kind, const Task& task) {
  require(leads_task(kind), "channel '" + name + "' is of a kind that leads no task, '" +
                                task.name() + "' came: Channel::drive, joint, joints make it");
  if (kind == ChannelKind::Force) {
    require(dynamic_cast<const ForceTask*>(&task),
            "channel '" + name + "' wants a ForceTask, '" + task.name() + "' is none");
  }
  if (kind == ChannelKind::Target) {
    require(task.target_size() > 0, "channel '" + name + "' sets a target as numbers, which '" +
                                        task.name() + "' does not take: a Twist moves it");
  }
}

}  // namespace

Channel::Channel(std::string name, ChannelKind kind, Vector scale,
                 std::vector<std::string> components)
    : name_(std::move(name)),
      kind_(kind),
      scale_(std::move(scale)),
      components_(std::move(components)) {
  require(!name_.empty(), "a channel wants a name");
  for (Index i = 0; i < scale_.size(); ++i) {
    require(scale_[i] > 0.0, "the scale of channel '" + name_ + "' wants numbers above 0, " +
                                 number_text(scale_[i]) + " came");
  }
  if (components_.empty()) components_ = usual_components(size());
  require(static_cast<Index>(components_.size()) == size(),
          "channel '" + name_ + "' wants " + std::to_string(size()) + " names of components");
}

Channel::Channel(std::string name, ChannelKind kind, Task& task, Vector scale,
                 std::vector<std::string> components)
    : Channel(std::move(name), kind, spread_over(std::move(scale), numbers_of(kind, task)),
              std::move(components)) {
  task_ = &task;
  require_target(name_, kind_, task);
  const Index numbers = numbers_of(kind_, task);
  require(size() == numbers, "the scale of channel '" + name_ + "' wants 1 or " +
                                 std::to_string(numbers) + " numbers, " + std::to_string(size()) +
                                 " came");
}

Channel Channel::drive(std::string name, double speed, double yaw_rate) {
  return {
      std::move(name), ChannelKind::Drive, Eigen::Vector2d(speed, yaw_rate), {"speed", "yaw_rate"}};
}

Channel Channel::joint(std::string name, std::string joint, double scale) {
  Channel channel(std::move(name), ChannelKind::Joint, Vector::Constant(1, scale), {});
  channel.joints_ = {std::move(joint)};
  return channel;
}

Channel Channel::joints(std::string name, std::vector<std::string> joints, double scale) {
  require(!joints.empty(), "channel '" + name + "' wants at least one joint");
  const auto size = static_cast<Index>(joints.size());
  Channel channel(std::move(name), ChannelKind::Joints, Vector::Constant(size, scale), joints);
  channel.joints_ = std::move(joints);
  return channel;
}

Channel Channel::control(std::string name, std::string actuator, double scale) {
  Channel channel(std::move(name), ChannelKind::Control, Vector::Constant(1, scale), {});
  channel.actuator_ = std::move(actuator);
  return channel;
}

std::vector<std::string> Channel::entries() const {
  if (size() == 1) return {name_};
  std::vector<std::string> names;
  for (const std::string& component : components_) names.push_back(name_ + "_" + component);
  return names;
}

Channel Channel::with_task(Task& task) const {
  Channel copy = *this;
  copy.task_ = &task;
  return copy;
}

}  // namespace hurcules
