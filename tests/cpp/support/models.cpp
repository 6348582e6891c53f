#include "support/models.hpp"

#include <string>

namespace hurcules_test {

std::string models(const std::string& path) {
  return HURCULES_MODELS + path;
}

}  // namespace hurcules_test
