// What Python gets from a solve: an answer that no later solve and no later change of an array
// moves.
//
// The solve copies its rows once (SolvedHierarchy: 0.3 us at n = 19); multipliers, level reports
// and the sensitivity are made from that copy when they are asked for.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hurcules/solver/sensitivity/level_report.hpp"
#include "hurcules/solver/sensitivity/sensitivity.hpp"
#include "hurcules/solver/solver.hpp"

namespace hurcules_bindings {

class Answer {
 public:
  Answer() = default;
  // right after the solve, while its arrays are unchanged
  explicit Answer(const hurcules::Solver& solver);

  [[nodiscard]] const hurcules::Solution& solution() const { return solution_; }
  [[nodiscard]] const std::vector<std::vector<hurcules::Vector>>& multipliers();
  [[nodiscard]] const std::vector<hurcules::LevelReport>& reports();
  [[nodiscard]] const hurcules::Sensitivity& sensitivity();

 private:
  hurcules::Solution solution_;
  std::shared_ptr<const hurcules::SolvedHierarchy> solved_;  // null where the method has none
  std::optional<std::vector<std::vector<hurcules::Vector>>> multipliers_;
  std::optional<std::vector<hurcules::LevelReport>> reports_;
  std::optional<hurcules::Sensitivity> sensitivity_;
};

}  // namespace hurcules_bindings
