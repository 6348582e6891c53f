// The folder models/ of this tree. One source knows its path, so that a compiler cache serves the
// others in any clone.
#pragma once

#include <string>

namespace hurcules_test {

std::string models(const std::string& path);  // models("/scenes/stretch.xml")

}  // namespace hurcules_test
