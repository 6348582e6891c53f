// Flags of episodes side by side, one each.
#pragma once

#include "hurcules/base/types.hpp"

namespace hurcules {

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;
using FlagsRef = Eigen::Ref<const Flags>;

}  // namespace hurcules
