// What a table asks of its scene beside the columns of the log: position/OBJECT/x, joint/JOINT,
// sensor/SENSOR (see data_quantity.hpp). They become columns.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/sim/data_quantity.hpp"
#include "hurcules/sim/plant.hpp"
#include "hurcules/sim/recorder.hpp"

namespace hurcules {

class SceneQuantities {
 public:
  // Of the names that the log has not, those that the model has: one of several numbers by its
  // part, /x /y /z of a position, /0 /1 ... else. Throws Error for an object that the model has not.
  // The log reads where they are, so this stays in place.
  void attach(const std::vector<std::string>& names, const Plant& plant, Recorder& log);
  void look();
  void save(StateWriter& writer) const { writer.put(values_); }
  void restore(StateReader& reader) { reader.get(values_); }

 private:
  const mjModel_* model_ = nullptr;
  const mjData_* data_ = nullptr;
  std::vector<std::pair<DataQuantity, Index>> found_;  // and where its values begin
  Vector values_;
};

}  // namespace hurcules
