// Where a table finds its quantities: the columns of the log, and what else it asks of its scene,
// position/OBJECT/x, joint/JOINT, sensor/SENSOR (see data_quantity.hpp), which become columns.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/sim/data_quantity.hpp"
#include "hurcules/sim/plant.hpp"
#include "hurcules/sim/recorder.hpp"

namespace hurcules {

class SceneQuantities {
 public:
  // keeps both
  void attach(const Plant& plant, Recorder& log);
  // Where the value of this name is, as long as this stays in place. One of several numbers is told
  // by its part: /x /y /z of a position, /0 /1 ... else. Throws Error with the columns that exist,
  // `where` for the text.
  [[nodiscard]] const double* find(const std::string& name, const std::string& where);
  void look();
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Found {
    DataQuantity quantity;
    Vector values;  // the log reads where they are
  };
  const Plant* plant_ = nullptr;
  Recorder* log_ = nullptr;
  std::vector<Found> found_;
};

}  // namespace hurcules
