/// @file Contact resolution: one contact, the closing speeds it changes, and whole batches.
#include <algorithm>
#include <memory>

#include "cairn/settings.h"
#include "kernel.h"
#include "pile.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"
#include "resolution/normal_rows.h"
#include "resolution/queue.h"
#include "resolution/resolution.h"

namespace cairn::kernels {

namespace {

/// Enough copies of the pile that no cache holds its contacts.
constexpr std::size_t many = 200;

/// A pile gathered for resolution, with the velocities to which every pass returns.
struct Gathered {
    explicit Gathered(std::size_t copies) : pile(makePile(copies)) {
        batch.gather(pile.batch(), pile.contacts, pile.state());
        for (ContactFrame& frame : batch.contacts) batch.updateCollisionMatrixOf(frame);
        bodies = batch.bodies;
        rows.begin(batch);
        delta.assign(batch.contacts.size() + 1, 0);
    }

    void restore() { batch.bodies = bodies; }

    /// @param use called with a contact and each of its bodies that contacts can change
    template <class Use>
    void forBodiesOf(std::uint32_t contact, const Use& use) const {
        const ContactFrame& frame = batch.contacts[contact];
        for (const std::uint32_t body : {frame.a, frame.b}) {
            if (!batch.isFixed(body)) use(contact, body);
        }
    }
    template <class Use>
    void forBodies(const Use& use) const {
        for (std::uint32_t contact = 0; contact < batch.contacts.size(); ++contact) forBodiesOf(contact, use);
    }

    Pile pile;
    LocalBatch batch;
    std::vector<LocalBody> bodies;
    NormalRows rows;
    std::vector<double> delta;
};

Pass gatherPass(std::size_t copies) {
    const auto pile = std::make_shared<Pile>(makePile(copies));
    const auto batch = std::make_shared<LocalBatch>();
    Pass pass;
    pass.items = static_cast<std::int64_t>(pile->contacts.size());
    pass.bytes = pass.items * static_cast<std::int64_t>(sizeof(Contact) + sizeof(ContactFrame));
    pass.prepare = [] {};
    pass.run = [pile, batch] {
        batch->gather(pile->batch(), pile->contacts, pile->state());
        keep(*batch);
    };
    return pass;
}

Pass resolvePass(std::size_t copies) {
    const auto gathered = std::make_shared<Gathered>(copies);
    Pass pass;
    pass.items = static_cast<std::int64_t>(gathered->batch.contacts.size());
    pass.bytes = static_cast<std::int64_t>(gathered->batch.contacts.size() * sizeof(ContactFrame) +
                                           2 * gathered->bodies.size() * sizeof(LocalBody));
    pass.prepare = [gathered] { gathered->restore(); };
    pass.run = [gathered] {
        LocalBatch& batch = gathered->batch;
        const double threshold = gathered->pile.settings.resolution.restitution_threshold;
        for (ContactFrame& frame : batch.contacts) {
            // An opening contact costs the same as a closing one here: each of them is resolved.
            const Vec3 velocity = batch.velocityOf(frame);
            const Vec3 closing(-std::abs(velocity[0]) - 1e-6, velocity[1], velocity[2]);
            applyImpulse(frame, contactImpulse(frame, closing, threshold), batch.bodies[frame.a],
                         batch.bodies[frame.b]);
        }
        keep(batch);
    };
    return pass;
}

Pass updatePass(std::size_t copies) {
    const auto gathered = std::make_shared<Gathered>(copies);
    Pass pass;
    for (std::uint32_t body = 0; body < gathered->batch.dynamic_bodies; ++body) {
        pass.items += static_cast<std::int64_t>(gathered->rows.contactsOf(body).size());
    }
    pass.bytes = pass.items * static_cast<std::int64_t>(sizeof(NormalRowPair) / 2 + sizeof(std::uint32_t)) +
                 2 * static_cast<std::int64_t>(gathered->delta.size() * sizeof(double));
    pass.prepare = [] {};
    pass.run = [gathered] {
        const VelocityChange change{Vec3(1e-3, 2e-3, -1e-3), Vec3(1e-2, -2e-2, 1e-2)};
        for (std::uint32_t body = 0; body < gathered->batch.dynamic_bodies; ++body) {
            gathered->rows.update(body, change, gathered->delta);
        }
        keep(gathered->delta);
    };
    return pass;
}

/// The queue alone: every contact closes, is taken as the fastest one, and opens.
Pass queuePass() {
    const auto gathered = std::make_shared<Gathered>(1);
    const auto queue = std::make_shared<TournamentQueue>();
    Pass pass;
    pass.items = static_cast<std::int64_t>(gathered->batch.contacts.size());
    pass.prepare = [gathered, queue] {
        Random random(5);
        for (double& delta : gathered->delta) delta = random.uniform(-1, -0.1);
        gathered->delta.back() = 1;
        queue->reset(gathered->rows.lists(), gathered->delta, 0);
        gathered->forBodies([&](std::uint32_t contact, std::uint32_t body) { queue->insert(contact, body); });
    };
    pass.run = [gathered, queue] {
        for (std::uint32_t contact = queue->next(); contact != no_contact; contact = queue->next()) {
            gathered->delta[contact] = 1;
            gathered->forBodiesOf(contact, [&](std::uint32_t, std::uint32_t body) { queue->bodyChanged(body); });
        }
        keep(*queue);
    };
    return pass;
}

/// A whole batch, from gathering to writing back.
Pass batchPass(std::string_view resolution) {
    const auto pile = std::make_shared<Pile>(makePile(1));
    setField(pile->settings, "resolution", std::string(resolution));
    const std::shared_ptr<Resolution> solver = makeResolution(pile->settings.resolution.resolution);
    const Pile begin = *pile;
    Pass pass;
    pass.items = static_cast<std::int64_t>(pile->contacts.size());
    pass.prepare = [pile, begin] {
        pile->v = begin.v;
        pile->w = begin.w;
        pile->contacts = begin.contacts;
    };
    pass.run = [pile, solver] {
        const BatchView batch = pile->batch();
        const BodyState state = pile->state();
        const Executor alone;
        const ResolutionCounts counts =
            solver->resolve({{&batch, 1}, pile->contacts, state, pile->settings.resolution, alone});
        keep(counts);
    };
    return pass;
}

}  // namespace

std::vector<Kernel> resolutionKernels() {
    std::vector<Kernel> kernels = {
        {"resolution/gather", "contact", [] { return gatherPass(1); }},
        {"resolution/resolve_contact", "contact", [] { return resolvePass(1); }},
        {"resolution/resolve_contact/from_memory", "contact", [] { return resolvePass(many); }},
        {"resolution/queue", "contact", queuePass},
        {"resolution/update_closing_speed", "speed", [] { return updatePass(1); }},
        {"resolution/update_closing_speed/from_memory", "speed", [] { return updatePass(many); }}};
    const auto fields = settingFields();
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [](const SettingField& candidate) { return candidate.name == "resolution"; });
    for (const std::string_view choice : field->choices) {
        if (choice == "none") continue;
        kernels.push_back(
            {"resolution/batch/" + std::string(choice), "contact", [choice] { return batchPass(choice); }});
    }
    return kernels;
}

}  // namespace cairn::kernels
