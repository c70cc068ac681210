/// @file How the displacement of one body pushes its neighbours: the search of the penetration correction.
///
/// A pushed body moves by the displacement of the one that pushes it, or by a fraction of it (2.3.6). So every
/// displacement of a search is a multiple of the first, and one number per body, its *share* in [0, 1], is enough. A
/// larger share of X never means a smaller one of Y and never fewer pushes; the longest displacement of each body (and
/// whether the search is valid) therefore does not depend on the order in which bodies are processed. Algorithm 3 takes
/// the latest push first; so do we among pushes of equal length, but longer ones go before shorter ones. Since no body
/// hands on more than it has, each body is then processed once, where a plain stack can come back to it many times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "correction/candidate.h"
#include "correction/push_graph.h"

namespace cairn {

/// How a search ended.
enum class PropagationOutcome : std::uint8_t {
    valid,
    invalid,    ///< a fixed body or the other body of the first contact would have to move
    abandoned,  ///< more bodies than allowed are moved
};

/// One search and its result: the bodies that move and how far. Nothing is moved. Its memory is reused by the next
/// search. @source thesis Algorithms 1 and 3
class Propagation {
  public:
    /// Is for the bodies of a batch from now on. @param place of each [slots] among so many
    void begin(std::span<const std::uint32_t> place, std::size_t bodies);

    /// Searches what the candidate's displacement moves. @param limit largest number of bodies worth knowing about
    PropagationOutcome run(const Candidate& candidate, PushGraph& graph, std::size_t limit);

    /// The displacement of the first body [m, W].
    const Vec3& displacement() const { return displacement_; }
    /// The bodies that move, beginning with the first; complete only after a valid search.
    std::span<const BodyIndex> moved() const { return moved_; }
    /// The fraction of displacement() by which a body of the batch moves, 0 if it does not.
    double share(BodyIndex body) const {
        const Entry& entry = entries_[place_[body]];
        return entry.search == search_ ? entry.share : 0;
    }

  private:
    /// One link of one body.
    struct Way {
        BodyIndex body = 0;
        std::uint32_t link = 0;
    };
    /// The longest displacement found for a body; counts only in the search that wrote it.
    struct Entry {
        std::uint64_t search = 0;
        double share = 0;
        Way pushed_by;  ///< of no meaning for the first body
    };
    /// A body that is moved, but has not pushed yet.
    struct Open {
        double share;
        BodyIndex body;

        friend bool operator<(const Open& left, const Open& right) { return left.share < right.share; }
    };

    bool extend(BodyIndex body, double share, const Way& pushed_by);
    bool pushNeighbours(const Open& open, const Candidate& candidate, PushGraph& graph);
    void rememberWayTo(BodyIndex body, const Candidate& candidate, PushGraph& graph) const;
    bool pop(Open& open);

    std::span<const std::uint32_t> place_;
    std::vector<Entry> entries_;  ///< [bodies of the batch]
    std::vector<BodyIndex> moved_;
    std::vector<Open> stack_;    ///< those pushed as far as the present one, which is the furthest
    std::vector<Open> shorter_;  ///< max-heap of the others
    std::uint64_t search_ = 0;   ///< number of the present search; no entry of entries_ is ever cleared
    Vec3 displacement_ = Vec3::Zero();
};

}  // namespace cairn
