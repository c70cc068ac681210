/// @file What acts along the free axes of joints, as bound rows.
#pragma once

#include "joints/joint_rows.h"

namespace cairn {

/// Bounds of the position, which become bounds of the rate: what is within them may come as far as they are.
void addLimits(const JointMotion& motion, double lower, double upper, double time_step, JointBlock& block);

/// All that acts along a free axis but its limits.
void addDrives(const JointMotion& motion, const FreeAxis& axis, double time_step, JointBlock& block);

}  // namespace cairn
