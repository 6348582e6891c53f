// How many working-set changes a solve may still make.
#pragma once

namespace hurcules {

struct Budget {
  int used = 0;
  int most = 0;

  [[nodiscard]] bool spent() const { return used >= most; }
  [[nodiscard]] int left() const { return most - used; }
};

}  // namespace hurcules
