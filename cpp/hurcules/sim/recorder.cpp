#include "hurcules/sim/recorder.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

void Recorder::add(std::string channel, const double* source) {
  require(rows_ == 0, "a channel wants to be added before the first row");
  channels_.push_back(std::move(channel));
  sources_.push_back(source);
}

void Recorder::add(const std::string& prefix, const std::vector<std::string>& names,
                   const Vector& sources) {
  require(static_cast<Index>(names.size()) == sources.size(),
          "channels '" + prefix + "' want one name a value");
  for (std::size_t i = 0; i < names.size(); ++i) {
    add(prefix + "/" + names[i], sources.data() + i);
  }
}

const double* Recorder::source(const std::string& channel) const {
  const auto found = std::find(channels_.begin(), channels_.end(), channel);
  if (found == channels_.end()) return nullptr;
  return sources_[static_cast<std::size_t>(found - channels_.begin())];
}

void Recorder::reserve(std::size_t rows) {
  const std::size_t wanted = (rows_ + rows) * columns();
  // at least twice what there was, so that many small requests cost no more than one
  if (wanted > values_.size()) values_.resize(std::max(wanted, 2 * values_.size()));
}

void Recorder::record() {
  require((rows_ + 1) * columns() <= values_.size(), "record wants room for a row: reserve it");
  double* const row = values_.data() + rows_ * columns();
  for (std::size_t i = 0; i < columns(); ++i) row[i] = *sources_[i];
  ++rows_;
}

void Recorder::truncate(double time) {
  while (rows_ > 0 && at(rows_ - 1, 0) >= time) --rows_;
}

Vector Recorder::series(std::size_t channel) const {
  Vector result(static_cast<Index>(rows_));
  for (std::size_t row = 0; row < rows_; ++row) result[static_cast<Index>(row)] = at(row, channel);
  return result;
}

double Recorder::at(std::size_t row, std::size_t channel) const {
  if (row >= rows_ || channel >= columns()) {
    throw Error("a log of " + std::to_string(rows_) + " rows and " + std::to_string(columns()) +
                " channels has no row " + std::to_string(row) + " of channel " +
                std::to_string(channel));
  }
  return values_[row * columns() + channel];
}

Vector Recorder::snapshot() const {
  Vector result(static_cast<Index>(columns()));
  for (std::size_t i = 0; i < columns(); ++i) result[static_cast<Index>(i)] = *sources_[i];
  return result;
}

}  // namespace hurcules
