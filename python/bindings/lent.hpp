// numpy -> Eigen for calls that compute little: the array is looked at where it lies. A cast to Eigen
// costs two to four times as much.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/base/types.hpp"

namespace hurcules_bindings {

// Numbers (n, k) of numpy where they lie; an array (n,) is a column. Own are those that are written
// to; of others a copy stands where the array has another type, or gaps within a row.
template <class Scalar, bool own = false>
class Lent {
 public:
  using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Data = std::conditional_t<own, Scalar, const Scalar>;
  template <class Plain>
  using Of = std::conditional_t<own, Plain, const Plain>;

  bool take(pybind11::handle source, bool convert) {
    namespace npy = pybind11::detail;
    static const PyObject* const kind = pybind11::dtype::of<Scalar>().release().ptr();
    if (!npy::npy_api::get().PyArray_Check_(source.ptr())) return copy(source, convert);
    const auto* const array = npy::array_proxy(source.ptr());
    const int needed =
        npy::npy_api::NPY_ARRAY_ALIGNED_ | (own ? npy::npy_api::NPY_ARRAY_WRITEABLE_ : 0);
    constexpr auto size = static_cast<pybind11::ssize_t>(sizeof(Scalar));
    const bool is_matrix = array->nd == 2, is_vector = array->nd == 1;
    if (array->descr != kind || (array->flags & needed) != needed || !(is_matrix || is_vector))
      return copy(source, convert);
    columns_ = is_matrix ? array->dimensions[1] : 1;
    rows_ = array->dimensions[0];
    stride_ = rows_ > 1 ? array->strides[0] / size : columns_;
    const bool close = columns_ < 2 || array->strides[1] == size;
    const bool apart = is_vector && stride_ != 1;
    if (!close || apart || stride_ < columns_ || (rows_ > 1 && array->strides[0] % size != 0))
      return copy(source, convert);
    data_ = reinterpret_cast<Data*>(array->data);
    return true;
  }

  [[nodiscard]] auto rows() const {
    return Eigen::Map<Of<Rows>, 0, Eigen::OuterStride<>>(data_, rows_, columns_,
                                                         Eigen::OuterStride<>(stride_));
  }

  // of an array (n,)
  [[nodiscard]] auto column() const {
    if (columns_ != 1 || (rows_ > 1 && stride_ != 1))
      throw hurcules::Error("wanted an array of one dimension without gaps");
    return Eigen::Map<Of<Column>>(data_, rows_);
  }

 private:
  bool copy(pybind11::handle source, bool convert) {
    using Close = pybind11::array_t<Scalar, pybind11::array::c_style | pybind11::array::forcecast>;
    if (own || !convert) return false;
    const Close close = Close::ensure(source);
    if (!close || close.ndim() < 1 || close.ndim() > 2) return false;
    copied_ = close;
    rows_ = close.shape(0);
    stride_ = columns_ = close.ndim() == 2 ? close.shape(1) : 1;
    data_ = const_cast<Data*>(close.data());
    return true;
  }

  Data* data_ = nullptr;
  Eigen::Index rows_ = 0, columns_ = 0, stride_ = 0;
  pybind11::object copied_;
};

// a new array, for a matrix (n, k), or (n,) for a vector
template <class Plain>
pybind11::array_t<typename Plain::Scalar> new_array(const Plain& values) {
  std::vector<pybind11::ssize_t> shape{values.rows()};
  if constexpr (Plain::ColsAtCompileTime != 1) shape.push_back(values.cols());
  pybind11::array_t<typename Plain::Scalar> array(shape);
  std::copy_n(values.data(), values.size(), array.mutable_data());
  return array;
}

}  // namespace hurcules_bindings

namespace pybind11::detail {

template <class Scalar, bool own>
struct type_caster<hurcules_bindings::Lent<Scalar, own>> {
  using Type = hurcules_bindings::Lent<Scalar, own>;
  PYBIND11_TYPE_CASTER(Type, type_caster<array_t<Scalar>>::name);
  bool load(handle source, bool convert) { return value.take(source, convert); }
};

}  // namespace pybind11::detail
