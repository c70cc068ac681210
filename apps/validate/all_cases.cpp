#include <vector>

#include "validate/cases/cases.h"

namespace cairn::validation {

std::span<const Case> allCases() {
    static const std::vector<Case> cases = {
        parabola,
        tumbling_box,
        dzhanibekov,
        symmetric_top,
        incline_threshold,
        incline_slide,
        incline_creep,
        static_over_kinetic,
        slide_to_roll,
        rolling_down,
        pulled_plate,
        bouncing,
        elastic_balls,
        two_body_impact,
        oblique_impact,
        cue_ball,
        cradle,
        cradle_swing,
        tipping,
        overhang,
        arch,
        seesaw,
        catapult,
        towers,
        walls,
        mass_ratios,
        dominoes_wave,
        gas,
        haff,
        packing,
        silo,
        hopper,
        repose,
        cube_toss,
    };
    return cases;
}

}  // namespace cairn::validation
