#include "command.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "hurcules/base/error.hpp"

namespace hurcules_bindings {

namespace py = pybind11;
using namespace hurcules;

namespace {

using Shape = std::vector<py::ssize_t>;

Shape shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

std::string text_of(const Shape& shape) {
  py::tuple sizes(shape.size());
  for (std::size_t i = 0; i < shape.size(); ++i) sizes[i] = shape[i];
  return std::string(py::str(sizes));
}

bool is_mapping(const py::object& command) {
  return !py::isinstance<py::array>(command) &&
         py::isinstance(command, py::module_::import("collections.abc").attr("Mapping"));
}

Array numbers_of(const std::string& what, const py::handle& values) {
  const Array numbers = Array::ensure(values);
  if (!numbers) {
    PyErr_Clear();
    throw Error(what + ": wanted numbers, got " + std::string(py::repr(values)));
  }
  if (!Eigen::Map<const Vector>(numbers.data(), numbers.size()).allFinite()) {
    throw Error(what + ": wanted " + std::to_string(numbers.size()) + " finite numbers, got " +
                std::string(py::repr(numbers)));
  }
  return numbers;
}

// rates are 0, so that in a mission they are not the operator's; targets and forces stay (NaN)
void hold(const WholeBodyController& controller, Matrix& all) {
  Index column = 0;
  for (const Channel& channel : controller.channels()) {
    if (!channel.sets()) all.middleCols(column, channel.size()).setZero();
    column += channel.size();
  }
}

// rows of what came, or of the values of all channels side by side; `shape`: of n numbers
template <class ShapeOf>
Matrix rows_of(const WholeBodyController& controller, const py::object& command, Index rows,
               const ShapeOf& shape) {
  const Index k = controller.scale().size();
  if (!is_mapping(command)) {
    const Array numbers = numbers_of("a command", command);
    if (const Shape came = shape_of(numbers); came != shape(k))
      throw Error("a command: wanted shape " + text_of(shape(k)) + ", got " + text_of(came));
    return Eigen::Map<const Matrix>(numbers.data(), rows, k);
  }
  const auto given = py::dict(command);
  std::vector<std::string> known;
  for (const Channel& channel : controller.channels()) known.push_back(channel.name());
  for (const auto& [name, values] : given) {
    const std::string text = py::str(name);
    if (std::find(known.begin(), known.end(), text) == known.end())
      throw Error(unknown_name("channel", text, known));
  }
  Matrix all = Matrix::Constant(rows, k, std::numeric_limits<double>::quiet_NaN());
  Index column = 0;
  for (const Channel& channel : controller.channels()) {
    const Index size = channel.size();
    if (const py::str name(channel.name()); given.contains(name) && !given[name].is_none()) {
      const std::string what = "channel '" + channel.name() + "'";
      const Array numbers = numbers_of(what, given[name]);
      if (numbers.size() != rows * size)
        throw Error(what + ": wanted shape " + text_of(shape(size)) + ", got " +
                    text_of(shape_of(numbers)));
      all.middleCols(column, size) = Eigen::Map<const Matrix>(numbers.data(), rows, size);
    }
    column += size;
  }
  if (all.array().isNaN().all()) hold(controller, all);
  return all;
}

// none where they name nothing
template <class Numbers>
std::optional<Numbers> given(const Numbers& numbers) {
  if (numbers.size() > 0 && numbers.array().isNaN().all()) return std::nullopt;
  return numbers;
}

}  // namespace

std::optional<Vector> command_of(const WholeBodyController& controller, const py::object& command) {
  if (command.is_none()) return std::nullopt;
  const auto shape = [](Index n) { return Shape{n}; };
  return given<Vector>(rows_of(controller, command, 1, shape).row(0).transpose());
}

std::optional<Matrix> commands_of(const WholeBodyController& controller, const py::object& commands,
                                  Index rows) {
  if (commands.is_none()) return std::nullopt;
  const auto shape = [rows](Index n) { return Shape{rows, n}; };
  return given<Matrix>(rows_of(controller, commands, rows, shape));
}

}  // namespace hurcules_bindings
