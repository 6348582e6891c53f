#include "hurcules/base/error.hpp"

#include <algorithm>
#include <numeric>

namespace hurcules {

void require(bool condition, std::string_view message) {
  if (!condition) throw Error(std::string(message));
}

namespace {

constexpr std::size_t kMostNames = 20, kNearest = 8;

// letters to put in, leave out or change (Levenshtein)
std::size_t distance(std::string_view one, std::string_view other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < one.size(); ++i) {
    std::size_t before = i;
    row[0] = i + 1;
    for (std::size_t j = 0; j < other.size(); ++j) {
      const std::size_t changed = before + (one[i] == other[j] ? 0 : 1);
      before = row[j + 1];
      row[j + 1] = std::min({changed, before + 1, row[j] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string unknown_name(std::string_view kind, std::string_view name,
                         const std::vector<std::string>& existing) {
  std::string text = std::string(kind) + " '" + std::string(name) + "' does not exist; there are: ";
  std::vector<std::string> told = existing;
  if (existing.size() > kMostNames) {
    std::stable_sort(told.begin(), told.end(),
                     [&](const std::string& one, const std::string& other) {
                       return distance(name, one) < distance(name, other);
                     });
    told.resize(kNearest);
  }
  for (std::size_t i = 0; i < told.size(); ++i) text += (i ? ", " : "") + told[i];
  if (told.size() < existing.size()) {
    text += " and " + std::to_string(existing.size() - told.size()) + " others";
  }
  return existing.empty() ? text + "none" : text;
}

void require_distinct(const std::vector<std::string>& names, std::string_view kind) {
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw Error("two " + std::string(kind) + " are called '" + *name + "'");
}

}  // namespace hurcules
