// The kernels on limits and values of candidates; part of kernels_impl.hpp.
#pragma once

namespace hurcules::kernels {
namespace {

double worst_excess(Size size, const double* value, LimitArrays limits, double relative,
                    double absolute) {
  Pack worst = spread(-kInfinite);
  for (Size j = 0; j < size; j += kWidth) {
    const Pack v = load(value + j);
    const Pack over = v - load(limits.upper + j), under = load(limits.lower + j) - v;
    const Pack excess = (over > under ? over : under) - relative * load(limits.norm + j);
    worst = excess > worst ? excess : worst;
  }
  double result = worst[0];
  for (int l = 1; l < kWidth; ++l) result = worst[l] > result ? worst[l] : result;
  return result - absolute;
}

Blocking first_blocking(Size size, const double* value, const double* target, LimitArrays limits,
                        double relative, double absolute) {
  Pack best = spread(1.0), best_speed = {}, best_index = spread(-1.0), index = {};
  for (int l = 0; l < kWidth; ++l) index[l] = l;
  for (Size j = 0; j < size; j += kWidth, index += kWidth) {
    const Pack v = load(value + j), goal = load(target + j), norm = load(limits.norm + j);
    const Pack upper = load(limits.upper + j), lower = load(limits.lower + j);
    const Pack allowed = relative * norm + absolute;
    const Mask over = (goal - upper) > allowed, under = (lower - goal) > allowed;
    const Pack move = goal - v;
    const Pack room = over ? upper - v : lower - v;
    Pack way = room / move;
    way = way > 0.0 ? way : Pack{};
    // a row that does not move towards the limit that it breaks cannot stop the move
    const Mask blocks = (over & (move > 0.0)) | (under & (move < 0.0));
    const Pack speed = (move > 0.0 ? move : -move) / norm;
    const Mask better = blocks & ((way < best) | ((way == best) & (speed > best_speed)));
    best = better ? way : best;
    best_speed = better ? speed : best_speed;
    best_index = better ? index : best_index;
  }
  Blocking first;
  double fastest = 0.0;
  for (int l = 0; l < kWidth; ++l) {
    if (best_index[l] < 0.0) continue;
    const bool tie = first.candidate >= 0 && best[l] == first.way;
    if (tie ? best_speed[l] <= fastest : best[l] > first.way) continue;
    first = {static_cast<Size>(best_index[l]), best[l]};
    fastest = best_speed[l];
  }
  return first;
}

double worsened(Size size, const double* before, const double* now, LimitArrays limits) {
  Pack worst = {};
  for (Size j = 0; j < size; j += kWidth) {
    const Pack was = load(before + j), is = load(now + j);
    const Pack lower = load(limits.lower + j), upper = load(limits.upper + j);
    const Pack over = is - (upper > was ? upper : was), under = (lower < was ? lower : was) - is;
    const Pack excess = (over > under ? over : under) / load(limits.norm + j);
    worst = excess > worst ? excess : worst;
  }
  double result = 0.0;
  for (int l = 0; l < kWidth; ++l) result = worst[l] > result ? worst[l] : result;
  return result;
}

void widen(Size size, const double* value, LimitArrays asked, double relative, double* lower,
           double* upper) {
  for (Size j = 0; j < size; j += kWidth) {
    const Pack v = load(value + j), allowed = relative * load(asked.norm + j);
    const Pack low = load(asked.lower + j), high = load(asked.upper + j);
    store(lower + j, v - low < allowed ? v : low);
    store(upper + j, high - v < allowed ? v : high);
  }
}

}  // namespace
}  // namespace hurcules::kernels
