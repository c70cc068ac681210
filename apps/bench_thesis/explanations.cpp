/// @file Why numbers differ from the thesis's by more than 30 %.
#include <map>

#include "section.h"

namespace cairn::thesis {

namespace {

/// By entry, or by section and quantity ("5.1//average") for those that all scenes share.
const std::map<std::string, std::string>& explanations() {
    static const std::map<std::string, std::string> texts = {
        {"5.4/stacks5/most_iterations",
         "Our walls have fewer contacts to go through: about 640 per time step at this maximum. The thesis does not "
         "say "
         "how many it had, nor at how many points two faces touch."},
        {"5.4//speedup",
         "It follows the iterations of the other order, and which closing contact that takes the thesis leaves open."},
        {"5.4//best_step_iterations",
         "A single step's ratio depends on the order of the list, which the thesis leaves to its contact detection."},
        {"5.4//best_step_time",
         "A single step's ratio depends on the order of the list, which the thesis leaves to its contact detection."},
    };
    return texts;
}

/// "5.1/stacks5/average" → "5.1//average".
std::string withoutScene(const std::string& id) {
    const std::size_t first = id.find('/');
    const std::size_t last = id.rfind('/');
    return first == last ? id : id.substr(0, first + 1) + id.substr(last);
}

}  // namespace

std::string explanationOf(const Entry& entry) {
    if (!entry.explanation.empty()) return entry.explanation;
    for (const std::string& key : {entry.id, withoutScene(entry.id)}) {
        const auto found = explanations().find(key);
        if (found != explanations().end()) return found->second;
    }
    return {};
}

}  // namespace cairn::thesis
