/// @file What of a step's batches is resolved: sleeping bodies are held still, as long as nothing pushes them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "batches/batch_motion.h"
#include "parallel/executor.h"

namespace cairn {

/// Which bodies may be left out of the resolution.
enum class Selecting : std::uint8_t {
    everything,     ///< none
    awake_batches,  ///< those of batches that sleep as a whole: the others wake as they are struck (the thesis)
    awake_parts     ///< all that sleep, until they are pushed beyond wake_speed
};

/// What a selection reads and writes.
struct SelectionInput {
    std::span<const BatchView> batches;  ///< of the step
    std::span<Contact> contacts;
    BodyState bodies;
    Selecting selecting;
    double wake_speed;  ///< what would move a sleeper faster wakes it [m/s]; 0 = batches wake as a whole
    const Executor& executor;
    /// [slots] what sleepers have without the contacts of their batches; empty = no more than what gravity gives them
    std::span<const BodyMotion> without_contacts{};
};

/// Chooses what a step resolves. Batches that sleep as a whole are left out, and their contacts go on with the impulses
/// that they had. Of a batch that sleeps in part, with Selecting::awake_parts, the sleeping bodies are held still, and
/// each contact between one and a body that is awake is compared with what it gave when both were resolved last. A body
/// that the difference would move faster than wake_speed is disturbed: it is resolved along with its surroundings, what
/// was resolved of the batch goes back and begins with the impulses that were found between others, and each time the
/// surroundings are taken four times as wide; where most of the batch would be resolved, all of it is. In the end those
/// wake that are faster than wake_speed, and the others sleep on in silence where they are. So an impact on a sleeping
/// pile wakes as much of it as it moves, in the same step, while one restless body in a large pile costs no more than
/// its neighbourhood. The same on any number of threads.
class Selection {
  public:
    /// Begins a step. All that is passed must stay until finish(), but for contacts' impulses and bodies' velocities,
    /// which the resolution of chosen() changes.
    void begin(const SelectionInput& input);
    /// What is to be resolved now: batches, or parts of them with joints of their own.
    std::span<const BatchView> chosen() const { return chosen_; }
    /// [slots] 1 = held still; empty = nobody is.
    std::span<const std::uint8_t> held() const { return held_; }
    /// To be called after chosen() was resolved: goes back to before that where held bodies were disturbed, and chooses
    /// those batches again with more of them and with the impulses that were found. @return whether there are such
    bool widen();
    /// Wakes who was pushed, and completes the contacts and joints.
    void finish();

  private:
    /// What is done with a body.
    enum class Part : std::uint8_t {
        free,  ///< resolved
        held,  ///< held still
        along  ///< resolved along with others, but left as it was unless that pushes it
    };
    enum class Choice : std::uint8_t { none, part, whole };

    /// A batch that is resolved in part: which places it has in the arrays of parts, and how many of them are in use.
    struct PartOfBatch {
        std::uint32_t batch = 0;
        std::size_t body_begin = 0;
        std::size_t contact_begin = 0;
        std::size_t joint_begin = 0;
        std::size_t bodies = 0;
        std::size_t contacts = 0;
        std::size_t joints = 0;
        int reach = 1;       ///< how many contacts far the surroundings of the next disturbed body go
        bool again = false;  ///< to be resolved once more
        bool took_along = false;
    };

    /// What the contacts of a sleeping body push more than when it was awake last.
    struct Disturbance {
        BodyIndex body;
        Vec3 linear = Vec3::Zero();   ///< [N·s]
        Vec3 angular = Vec3::Zero();  ///< about the centre of mass [N·m·s]
        double squared_reach = 0;     ///< of the farthest contact from the centre of mass [m²]
    };

    /// Kept memory of a thread.
    struct Scratch {
        std::vector<Disturbance> disturbances;
        std::vector<BodyIndex> taken;
    };

    Choice choiceOf(const BatchView& batch) const;
    bool sleeps(BodyIndex i) const { return bodies().asleep[i] != 0 && isAtRest(bodies(), i); }
    void finishContact(Contact& contact) const;
    bool isHeld(BodyIndex i) const { return part_[i] == Part::held; }
    bool isFree(BodyIndex i) const { return !isHeld(i) && !bodies().isFixed(i); }
    const BodyState& bodies() const { return input_->bodies; }
    const BatchView& batchOf(const PartOfBatch& part) const { return input_->batches[part.batch]; }

    void hold(BodyIndex i);
    void release(BodyIndex i);
    void addParts();
    void beginPart(PartOfBatch& part);
    void takeAlong(PartOfBatch& part, BodyIndex i);
    void takeTiedAlong(PartOfBatch& part);
    void takeAllAlongUnlessWorthwhile(PartOfBatch& part);
    void takeAroundAlong(PartOfBatch& part, std::vector<BodyIndex>& disturbed);
    void select(PartOfBatch& part);
    void listChosen();
    bool findDisturbed(const PartOfBatch& part, Scratch& scratch);
    void disturb(BodyIndex i, const Vec3& impulse, const Vec3& r, Scratch& scratch);
    void revert(const PartOfBatch& part);
    bool isPushed(BodyIndex i) const;
    void wakePushed(const PartOfBatch& part);
    BatchView viewOf(const PartOfBatch& part);
    template <class Work>
    void forParts(const Work& work);

    std::optional<SelectionInput> input_;
    bool anybody_sleeps_ = false;
    std::vector<Choice> choice_;     ///< [batches]
    std::vector<BatchView> chosen_;  ///< ascending by their batches
    std::vector<PartOfBatch> parts_;
    std::vector<Part> part_;                    ///< [slots]
    std::vector<std::uint8_t> held_;            ///< [slots] 1 = part_ is held
    std::vector<std::uint32_t> index_of_;       ///< [slots] in disturbances; none outside of who uses it
    std::vector<double> squared_reach_;         ///< [slots] of the farthest contact of who is taken along [m²]
    std::vector<BodyIndex> part_bodies_;        ///< by parts, ascending in each
    std::vector<BodyMotion> before_;            ///< [part_bodies_]
    std::vector<std::uint32_t> part_contacts_;  ///< by parts, ascending in each
    std::vector<JointBlock> part_joints_;       ///< copies, so that what is undone leaves nothing behind
    std::vector<std::uint32_t> joint_of_part_;  ///< [part_joints_] index in the batch
    std::vector<Scratch> scratch_;              ///< [threads]
};

}  // namespace cairn
