/// @file Penetration correction of one contact of a pile.
#include "correction/correction.h"

#include <algorithm>
#include <memory>

#include "kernel.h"
#include "pile.h"

namespace cairn::kernels {

namespace {

/// Every so many contacts one is deeper than the threshold.
constexpr std::size_t deep_every = 20;

Pile pileWithDeepContacts() {
    Pile pile = makePile(1);
    for (std::size_t i = 0; i < pile.contacts.size(); ++i) {
        const double threshold = pile.contacts[i].allowed_overlap;
        double& distance = pile.contacts[i].distance;
        distance = std::max(distance, -0.9 * threshold);
        if (i % deep_every == 0) distance = -1.4 * threshold;
    }
    return pile;
}

Pass correctPass() {
    const auto pile = std::make_shared<Pile>(pileWithDeepContacts());
    const Pile begin = *pile;
    const auto contacts_of = std::make_shared<ContactsOfBodies>();
    listContacts(pile->kind, pile->contacts, *contacts_of);
    const std::shared_ptr<Correction> correction = makeCorrection(pile->settings.correction.correction);
    Pass pass;
    pass.prepare = [pile, begin] {
        pile->position = begin.position;
        pile->contacts = begin.contacts;
    };
    pass.run = [pile, contacts_of, correction] {
        CorrectionCounts counts =
            correction->correct(pile->batch(), *contacts_of, pile->contacts, pile->state(), remaining_penetration);
        keep(counts);
    };
    for (const Contact& contact : pile->contacts) {
        if (contact.isTooDeep()) ++pass.items;
    }
    return pass;
}

}  // namespace

std::vector<Kernel> correctionKernels() {
    return {{"correction/correct_contact", "contact", correctPass}};
}

}  // namespace cairn::kernels
