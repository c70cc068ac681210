/// @file The list of cases, each in a file of its own.
#pragma once

#include "validate/case.h"

namespace cairn::validation {

extern const Case parabola, tumbling_box, dzhanibekov, symmetric_top;
extern const Case incline_threshold, incline_slide, incline_creep, static_over_kinetic;
extern const Case slide_to_roll, rolling_down, pulled_plate;
extern const Case bouncing, elastic_balls, two_body_impact, oblique_impact, cue_ball, cradle;

extern const Case towers, walls, mass_ratios, tipping, overhang;

extern const Case gas, haff, dominoes_wave;
extern const Case cradle_swing, arch, seesaw, catapult;
extern const Case packing, silo, hopper, repose;
extern const Case cube_toss;

}  // namespace cairn::validation
