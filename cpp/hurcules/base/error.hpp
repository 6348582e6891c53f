// The one exception of the library: wrong input, found at set-up.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hurcules {

// Text: what was wanted, what came, and where; for a name also the names that exist.
class Error : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// Throws Error(message) unless condition. For set-up only: the control tick never throws.
void require(bool condition, std::string_view message);

// "frame 'hnad' does not exist; there are: hand, head, pelvis"
[[nodiscard]] std::string unknown_name(std::string_view kind, std::string_view name,
                                       const std::vector<std::string>& existing);

// Throws Error for a name that stands twice: "two channels are called 'hand'".
void require_distinct(const std::vector<std::string>& names, std::string_view kind);

}  // namespace hurcules
