#include "hurcules/mission/scene_quantities.hpp"

#include <array>
#include <optional>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

// "position/cube/z" is a part of "position/cube"; a name without parts is its own whole
std::string whole_of(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  const std::string part = slash == std::string::npos ? "" : name.substr(slash + 1);
  const bool axis = name.starts_with("position/") && (part == "x" || part == "y" || part == "z");
  const bool number = name.starts_with("sensor/") && !part.empty() &&
                      part.find_first_not_of("0123456789") == std::string::npos &&
                      name.find('/') != slash;
  return axis || number ? name.substr(0, slash) : name;
}

std::string part_name(const std::string& whole, Index part, Index size) {
  if (size == 1) return whole;
  constexpr std::array kAxes = {"x", "y", "z"};
  const bool axes = whole.starts_with("position/");
  return whole + '/' + (axes ? kAxes[static_cast<std::size_t>(part)] : std::to_string(part));
}

}  // namespace

void SceneQuantities::attach(const Plant& plant, Recorder& log) {
  plant_ = &plant;
  log_ = &log;
}

const double* SceneQuantities::find(const std::string& name, const std::string& where) {
  const std::string whole = whole_of(name);
  if (!log_->source(name)) {
    std::optional<DataQuantity> quantity;
    try {
      quantity = DataQuantity::find(*plant_->model(), whole);
    } catch (const Error& error) {
      const bool of_position = name.starts_with("position/") && whole == name;
      throw Error(where + ", quantity '" + name + "': " + error.what() +
                  (of_position ? "; a position is told by its /x, /y or /z" : ""));
    }
    if (quantity) {
      const Index size = quantity->size();
      const Vector& values = found_.emplace_back(Found{*quantity, Vector::Zero(size)}).values;
      for (Index part = 0; part < size; ++part)
        log_->add(part_name(whole, part, size), values.data() + part);
    }
  }
  const double* const source = log_->source(name);
  if (!source)
    throw Error(
        where + ": " + unknown_name("quantity", name, log_->channels()) +
        "; simulation.channels has all, and the model may have position/OBJECT/x, "
        "distance/OBJECT/OBJECT, joint/JOINT, sensor/SENSOR (/0, /1, ... of several numbers), "
        "contact_force/BODY");
  return source;
}

void SceneQuantities::look() {
  for (Found& found : found_) found.quantity.read(*plant_->model(), *plant_->data(), found.values);
}

void SceneQuantities::save(StateWriter& writer) const {
  for (const Found& found : found_) writer.put(found.values);
}

void SceneQuantities::restore(StateReader& reader) {
  for (Found& found : found_) reader.get(found.values);
}

}  // namespace hurcules
