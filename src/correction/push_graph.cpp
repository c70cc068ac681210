#include "correction/push_graph.h"

#include "math/arrays.h"

namespace cairn {

namespace {

constexpr std::uint32_t no_link = UINT32_MAX;

/// Ways can lead in circles. Those that end are rarely longer than a pile is wide.
constexpr int longest_way = 64;

}  // namespace

void PushGraph::reset(const ContactsOfBodies& contacts_of, std::span<const Contact> contacts, const BodyState& bodies,
                      double remaining) {
    contacts_of_ = &contacts_of;
    contacts_ = contacts;
    kind_ = bodies.kind;
    remaining_ = remaining;
    ++round_;
    if (nodes_.size() < bodies.size()) nodes_.resize(bodies.size());
    if (links_.size() < contacts_of.contacts.size()) resizeTightly(links_, contacts_of.contacts.size());
}

void PushGraph::pack(BodyIndex body) {
    const std::span<const std::uint32_t> indices = (*contacts_of_)[body];
    PushLink* link = links_.data() + contacts_of_->begin[body];
    for (const std::uint32_t index : indices) {
        const Contact& contact = contacts_[index];
        const bool is_a = contact.a == body;
        const BodyIndex neighbour = is_a ? contact.b : contact.a;
        const Vec3 direction = is_a ? Vec3(-contact.normal) : contact.normal;  // n points from B to A
        *link++ = {direction, contact.distance + remaining_ * contact.allowed_overlap, neighbour,
                   kind_[neighbour] != BodyKind::dynamic};
    }
    nodes_[body].count = static_cast<std::uint32_t>(indices.size());
    nodes_[body].packed = round_;
}

void PushGraph::rememberWay(BodyIndex body, const Vec3& displacement, std::uint32_t link) {
    Node& node = nodes_[body];
    if (node.known != round_) node.ways.fill(no_link);
    node.known = round_;
    node.ways[octant(displacement)] = link;
}

bool PushGraph::isBlocked(BodyIndex body, double share, const Candidate& candidate) {
    const std::size_t direction = octant(candidate.displacement);
    for (int step = 0; step < longest_way; ++step) {
        const Node& node = nodes_[body];
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
