#include "hurcules/base/error.hpp"

namespace hurcules {

void require(bool condition, std::string_view message) {
  if (!condition) throw Error(std::string(message));
}

std::string unknown_name(std::string_view kind, std::string_view name,
                         const std::vector<std::string>& existing) {
  std::string text = std::string(kind) + " '" + std::string(name) + "' does not exist; there are: ";
  for (std::size_t i = 0; i < existing.size(); ++i) text += (i ? ", " : "") + existing[i];
  return existing.empty() ? text + "none" : text;
}

}  // namespace hurcules
