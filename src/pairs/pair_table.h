/// @file Stage 3: the pairs of bodies near each other, and the contacts of those that touch.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "body/material_table.h"
#include "broad_phase/neighbour_list.h"
#include "pairs/foreseen.h"
#include "pairs/found_contacts.h"
#include "parallel/executor.h"

namespace cairn {

/// What the contacts of pairs depend on.
struct PairsInput {
    BodyStorage& bodies;  ///< detect() notes where it found them
    const MaterialTable& materials;
    BroadPhase& broad_phase;
    std::span<const BodyPair> excluded;  ///< pairs that joints keep from touching, sorted
    const DetectionRange& range;         ///< which contacts are found
    const Executor& executor;
};

/// Whom the resolution may have sent elsewhere than foreseen.
struct MaybeStruck {
    double fastest;                         ///< bodies are followed as far as this speed leads them [m/s]
    std::span<const std::uint8_t> stopped;  ///< [slots] 1 = what was foreseen of it did not hold; empty = nobody
    std::span<const std::uint8_t> held;     ///< [slots] 1 = neither did it when it flew last; empty = nobody
    /// Those that have other velocities than in the last call; none = any body may have.
    std::optional<std::span<const BodyIndex>> changed;
};

/// Bodies that come and go between two detections.
struct PairChange {
    std::span<const std::uint8_t> left;  ///< [slots] 1 = its body left
    std::span<const BodyIndex> came;
    std::span<const Contact> contacts;  ///< of those that came, sorted by (a, b)
};

/// The pairs of bodies near each other, in the order of their slots. A pair lives as long as the bounds that its bodies
/// were searched with overlap; its contacts are found anew where a body is not where it was detected last
/// (BodyArrays::detected_position). What is found depends on poses and shapes alone. The impulses that new contacts
/// begin with are matched afterwards.
class PairTable {
  public:
    /// Drops the pairs of bodies that are no longer there.
    /// @param generation [slots] of the bodies that the contacts of the last step are of
    void beginStep(const BodyStorage& bodies, std::span<const std::uint32_t> generation);
    /// Finds the contacts of all pairs where the bodies are now, as often in a step as bodies were displaced.
    /// @param contacts in: those of the last call, with the impulses that the next ones inherit in last_impulse and
    ///        reference_impulse; out: sorted by (a, b) @throws InputError beyond most_contacts
    void detect(const PairsInput& input, std::vector<Contact>& contacts);

    /// Whether the last detection found bodies that moved deeper in each other than flights may lead them.
    bool foundDeep() const;

    /// Finds the contacts of some bodies once more, since they went back where they came from. @pre detect() was the
    /// last call, or this @param back [slots] 1 = it did @param contacts as of detect()
    void detectBack(const PairsInput& input, std::span<const std::uint8_t> back, std::vector<Contact>& contacts);

    /// Finds the contacts that nobody foresaw, since a body of theirs was struck by the resolution, and adds them
    /// behind those of their pairs; contacts that would not keep their bodies apart after all are tightened. @pre
    /// detect() was the last call, and it looked ahead
    /// @param contacts with impulses, which they keep @param added out: indices of the new and the tightened ones,
    /// ascending
    void followStruck(const PairsInput& input, const MaybeStruck& whom, std::vector<Contact>& contacts,
                      std::vector<std::uint32_t>& added);

    /// To be called when filters may keep other bodies apart than before: all pairs are asked in the next step.
    void askAll() { asks_all_ = true; }
    /// To be called when contacts would be others though no body moved: all are found anew.
    void forgetContacts() { known_ = false; }
    /// To be called when bodies and contacts are others: all pairs are those of the contacts.
    /// @param contacts sorted by (a, b)
    void adopt(std::span<const Contact> contacts);

    /// To be called when some bodies left their slots, with their contacts, and others came with theirs: all else
    /// stays.
    void change(const PairChange& change, std::vector<Contact>& contacts);
    /// To be called when bodies stand in other slots. @pre no pair is of a slot that is gone
    void rearrange(const SlotMove& move);

    /// All of them, sorted by (a, b), whether they touch or not.
    std::span<const ContactPair> pairs() const { return neighbours_.pairs(); }
    /// [slots] grown by the margin, and by the way ahead with speculative contacts [m, W]; empty before the first
    /// detection.
    std::span<const Bounds> bounds() const { return bounds_; }
    /// Another number whenever contacts are of other pairs, or a pair has more or fewer, than before.
    std::uint64_t layout() const { return layout_; }

  private:
    /// What is known of the bodies of a pair.
    enum class PairState : std::uint8_t {
        moved,     ///< nothing
        settled,   ///< they are where they were detected last, and go nowhere
        went_back  ///< at least one of them was detected where it does not stay
    };

    void findUnmoved(const PairsInput& input);
    void findBounds(const PairsInput& input);
    template <class Work>
    void forParts(const Executor& executor, const Work& work);
    void detectPair(const PairsInput& input, std::span<const Contact> last, PairState state, Manifold& manifold,
                    ContactPair& pair, FoundContacts& part);
    void detectPairs(const PairsInput& input, std::span<const Contact> last, FoundContacts& part);
    void detectPairsBack(const PairsInput& input, std::span<const Contact> last, std::span<const std::uint8_t> back,
                         FoundContacts& part);
    void findBoundsOf(const BodyStorage& bodies, BodyIndex i);
    void join(const PairsInput& input, std::vector<Contact>& contacts);
    bool findStruck(const PairsInput& input, const DetectionRange& range, const MaybeStruck& whom);
    void follow(const PairsInput& input, const DetectionRange& range, const MaybeStruck& whom, BodyIndex i);
    void followPairs(const PairsInput& input, const DetectionRange& range, std::span<const Contact> contacts,
                     FoundContacts& part);
    void addGrown(FoundContacts& part);
    void addFirst(const Executor& executor);

    NeighbourList neighbours_;
    std::vector<std::uint8_t> others_;   ///< [slots] 1 = its body was removed since the last step
    bool known_ = false;                 ///< the contacts are those of the last detection
    bool asks_all_ = false;              ///< no pair is settled
    DetectionRange range_;               ///< of the last detection
    std::vector<BodyAhead> ahead_;       ///< [slots]
    std::vector<std::uint8_t> unmoved_;  ///< [slots] 1 = contacts with others of these are known
    std::vector<std::uint8_t> settled_;  ///< [slots] 1 = unmoved, not looked ahead for, and no call since
    std::vector<std::uint8_t> struck_;   ///< [slots] 1 = the resolution sent it elsewhere than foreseen
    std::vector<Bounds> bounds_;         ///< [slots]
    std::vector<FoundContacts> parts_;   ///< [threads]
    std::vector<BodyPair> excluded_;     ///< in the last detection
    ContactJoiner joiner_;
    std::uint64_t layout_ = 1;
    std::vector<BodyIndex> came_;             ///< since the last detection
    std::vector<ContactPair> changed_pairs_;  ///< kept memory
    std::vector<Contact> changed_contacts_;   ///< kept memory
};

}  // namespace cairn
