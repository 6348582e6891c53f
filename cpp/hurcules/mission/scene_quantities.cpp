#include "hurcules/mission/scene_quantities.hpp"

#include <algorithm>
#include <array>

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

void SceneQuantities::attach(const std::vector<std::string>& names, const Plant& plant,
                             Recorder& log) {
  model_ = plant.model();
  data_ = plant.data();
  std::vector<std::string> wholes;
  Index size = 0;
  for (const std::string& name : names) {
    const std::string whole = whole_of(name);
    const bool known = std::find(wholes.begin(), wholes.end(), whole) != wholes.end();
    if (known || log.source(name)) continue;
    std::optional<DataQuantity> quantity;
    try {
      quantity = DataQuantity::find(*model_, whole);
    } catch (const Error& error) {
      throw Error("quantity '" + name + "': " + error.what());
    }
    if (!quantity) continue;
    wholes.push_back(whole);
    found_.emplace_back(*quantity, size);
    size += quantity->size();
  }
  values_ = Vector::Zero(size);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const auto& [quantity, begin] = found_[i];
    for (Index part = 0; part < quantity.size(); ++part)
      log.add(part_name(wholes[i], part, quantity.size()), values_.data() + begin + part);
  }
}

void SceneQuantities::look() {
  for (const auto& [quantity, begin] : found_)
    quantity.read(*model_, *data_, values_.segment(begin, quantity.size()));
}

}  // namespace hurcules
