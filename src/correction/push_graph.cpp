#include "correction/push_graph.h"

#include "math/arrays.h"

namespace cairn {

namespace {

constexpr std::uint32_t no_link = UINT32_MAX;

/// Ways can lead in circles. Those that end are rarely longer than a pile is wide.
constexpr int longest_way = 64;

}  // namespace

void PushGraph::reset(const BatchView& batch, const ContactsOfBodies& contacts_of, std::span<const Contact> contacts,
                      const BodyState& bodies, double remaining) {
    contacts_of_ = &contacts_of;
    contacts_ = contacts;
    kind_ = bodies.kind;
    place_ = bodies.place;
    remaining_ = remaining;
    ++round_;
    if (nodes_.size() < batch.bodies.size()) resizeTightly(nodes_, batch.bodies.size());
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < batch.bodies.size(); ++i) {
        nodes_[i].first = first;
        nodes_[i].count = static_cast<std::uint32_t>(contacts_of[batch.bodies[i]].size());
        first += nodes_[i].count;
    }
    if (links_.size() < first) resizeTightly(links_, first);
}

void PushGraph::pack(BodyIndex body) {
    Node& node = nodes_[place_[body]];
    PushLink* link = links_.data() + node.first;
    for (const std::uint32_t index : (*contacts_of_)[body]) {
        const Contact& contact = contacts_[index];
        const bool is_a = contact.a == body;
        const BodyIndex neighbour = is_a ? contact.b : contact.a;
        const Vec3 direction = is_a ? Vec3(-contact.normal) : contact.normal;  // n points from B to A
        *link++ = {direction, contact.distance + remaining_ * contact.allowed_overlap, neighbour,
                   kind_[neighbour] != BodyKind::dynamic};
    }
    node.packed = round_;
}

void PushGraph::rememberWay(BodyIndex body, const Vec3& displacement, std::uint32_t link) {
    Node& node = nodes_[place_[body]];
    if (node.known != round_) node.ways.fill(no_link);
    node.known = round_;
    node.ways[octant(displacement)] = link;
}

bool PushGraph::isBlocked(BodyIndex body, double share, const Candidate& candidate) {
    const std::size_t direction = octant(candidate.displacement);
    for (int step = 0; step < longest_way; ++step) {
        const Node& node = nodes_[place_[body]];
        if (node.known != round_ || node.ways[direction] == no_link) return false;
        const PushLink& link = linksOf(body)[node.ways[direction]];
        const Push push = pushThrough(link, share, candidate.displacement);
        if (!push.happens) return false;
        if (link.neighbour_fixed || link.neighbour == candidate.other) return true;
        if (!(push.share > 0)) return false;
        body = link.neighbour;
        share = push.share;
    }
    return false;
}

}  // namespace cairn
