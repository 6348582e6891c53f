// The kernels on limits and values of candidates; part of impl.hpp.
#pragma once

namespace hurcules::kernels {
namespace {

// The largest f(j) over packs of any number of candidates, not less than `least`; the last pack may
// take some once more. `one` is f of a single candidate.
template <class F, class One>
inline double largest_of(Size size, double least, F f, One one) {
  double result = least;
  if (size < kWidth) {
    for (Size j = 0; j < size; ++j) {
      const double v = one(j);
      result = v > result ? v : result;
    }
    return result;
  }
  Pack worst = spread(least);
  for (Size j = 0; j < size; j += kWidth) {
    const Pack v = f(j + kWidth > size ? size - kWidth : j);
    worst = v > worst ? v : worst;
  }
  for (int l = 0; l < kWidth; ++l) result = worst[l] > result ? worst[l] : result;
  return result;
}

double worst_excess(Size size, const double* value, LimitArrays limits, double relative,
                    double absolute) {
  const auto excess = [&](auto v, auto upper, auto lower, auto norm) {
    const auto over = v - upper, under = lower - v;
    return (over > under ? over : under) - relative * norm;
  };
  const auto pack = [&](Size j) {
    return excess(load(value + j), load(limits.upper + j), load(limits.lower + j),
                  load(limits.norm + j));
  };
  const auto one = [&](Size j) {
    return excess(value[j], limits.upper[j], limits.lower[j], limits.norm[j]);
  };
  return largest_of(size, -kInfinite, pack, one) - absolute;
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
    // a row that does not move towards the limit that it breaks cannot stop the move
    const Mask blocks = (over & (move > 0.0)) | (under & (move < 0.0));
    const Pack room = over ? upper - v : lower - v;
    Pack way = room / move;
    way = way > 0.0 ? way : Pack{};
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
  const auto excess = [](auto was, auto is, auto lower, auto upper, auto norm) {
    const auto over = is - (upper > was ? upper : was), under = (lower < was ? lower : was) - is;
    return (over > under ? over : under) / norm;
  };
  const auto pack = [&](Size j) {
    return excess(load(before + j), load(now + j), load(limits.lower + j), load(limits.upper + j),
                  load(limits.norm + j));
  };
  const auto one = [&](Size j) {
    return excess(before[j], now[j], limits.lower[j], limits.upper[j], limits.norm[j]);
  };
  return largest_of(size, 0.0, pack, one);
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
