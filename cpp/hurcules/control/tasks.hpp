// Every task that a stack can be made of: missions reach the tasks through the controller's room.
#pragma once

#include "hurcules/tasks/angle_task.hpp"
#include "hurcules/tasks/balance_task.hpp"
#include "hurcules/tasks/center_of_mass_task.hpp"
#include "hurcules/tasks/contact_task.hpp"
#include "hurcules/tasks/custom_task.hpp"
#include "hurcules/tasks/damping_task.hpp"
#include "hurcules/tasks/distance_task.hpp"
#include "hurcules/tasks/force_task.hpp"
#include "hurcules/tasks/gaze_task.hpp"
#include "hurcules/tasks/orientation_task.hpp"
#include "hurcules/tasks/pose_task.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "hurcules/tasks/swivel_task.hpp"
#include "hurcules/tasks/torque_limits.hpp"
#include "hurcules/tasks/zero_moment_task.hpp"
