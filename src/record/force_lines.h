/// @file Forces of a frame as lines, for drawing force chains.
#pragma once

#include <vector>

#include "cairn/recording.h"
#include "record/vtk_file.h"

namespace cairn {

/// Makes the lines of frames: from the centre of mass of each body that can move to where a force acts on it.
class ForceLines {
  public:
    /// @param steps_per_second that make impulses of a time step forces @param scene must outlive this
    ForceLines(const Scene& scene, double steps_per_second);
    /// Overwrites lines with those of a frame.
    void of(const Frame& frame, VtkLines& lines) const;

  private:
    struct Force;
    void add(const Frame& frame, const Force& force, VtkLines& lines) const;

    const Scene* scene_;
    double steps_per_second_;
    std::vector<Vec3> centres_;  ///< of mass, of bodies that move [m, frame of the shape]
};

}  // namespace cairn
