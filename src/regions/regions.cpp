#include "regions/regions.h"

#include <fmt/core.h>

#include <algorithm>

namespace cairn {

namespace {

int longestAxis(std::span<const Vec3> places) {
    if (places.empty()) return 0;
    Vec3 lower = places.front();
    Vec3 upper = places.front();
    for (const Vec3& place : places) {
        lower = lower.cwiseMin(place);
        upper = upper.cwiseMax(place);
    }
    int axis = 0;
    (upper - lower).maxCoeff(&axis);
    return axis;
}

/// The axis that so many ranks are cut across, and how many of them come before the plane.
struct Cut {
    int axis;
    int before;
};

Cut cutOf(const Partition& partition, std::span<const Vec3> places, int ranks) {
    using enum PartitionKind;
    if (partition.kind == x || partition.kind == y || partition.kind == z) {
        return {static_cast<int>(partition.kind) - static_cast<int>(x), ranks / 2};
    }
    if (partition.kind == grid) {
        // Slabs first: as long as more ranks are together than one slab has, whole slabs are parted.
        int each = ranks;
        for (int axis = 0; axis < 3; ++axis) {
            int beneath = 1;
            for (int other = axis + 1; other < 3; ++other) beneath *= partition.parts[static_cast<std::size_t>(other)];
            if (ranks <= beneath) continue;
            each = ranks / beneath;
            return {axis, each / 2 * beneath};
        }
    }
    return {longestAxis(places), ranks / 2};
}

/// A plane that so many places are below. Where there is a wide gap nearby it goes through that, since bodies near a
/// plane are those that ranks must tell each other of. @param count < places.size()
double planeBelow(std::span<Vec3> places, int axis, std::size_t count) {
    constexpr std::size_t nearby_part = 32;  // of the places on each side
    constexpr double wide = 20;              // mean gaps; among random places there is none
    const std::size_t nearby = places.size() / nearby_part;
    const std::size_t begin = count - std::min(count, nearby);
    const std::size_t end = std::min(places.size(), count + nearby + 1);
    const auto isBelow = [axis](const Vec3& p, const Vec3& q) { return p[axis] < q[axis]; };
    const auto at = [&](std::size_t i) { return places.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(0), at(begin), places.end(), isBelow);
    std::partial_sort(at(begin), at(end), places.end(), isBelow);
    double best = wide * (places[end - 1][axis] - places[begin][axis]) / static_cast<double>(end - begin);
    double plane = places[count][axis];
    for (std::size_t i = begin + 1; i < end; ++i) {
        const double gap = places[i][axis] - places[i - 1][axis];
        // Of gaps as wide as each other the one nearest to the middle.
        const std::size_t away = i > count ? i - count : count - i;
        const double worth = gap * (1 - 0.5 * static_cast<double>(away) / static_cast<double>(nearby + 1));
        if (worth <= best) continue;
        best = worth;
        plane = places[i - 1][axis] + gap / 2;
    }
    return plane;
}

}  // namespace

Regions::Regions(const Partition& partition, int ranks, std::vector<Vec3> places) {
    cut(partition, places, 0, ranks);
}

void Regions::cut(const Partition& partition, std::span<Vec3> places, int first, int ranks) {
    const std::size_t node = nodes_.size();
    nodes_.emplace_back().rank = first;
    if (ranks == 1) return;
    const auto [axis, before] = cutOf(partition, places, ranks);
    const std::size_t count = places.size() * static_cast<std::size_t>(before) / static_cast<std::size_t>(ranks);
    double plane = 0;
    std::span<Vec3> below = places;
    std::span<Vec3> above;
    if (!places.empty()) {
        plane = planeBelow(places, axis, count);
        const auto end = std::partition(places.begin(), places.end(),
                                        [&, axis = axis](const Vec3& place) { return place[axis] < plane; });
        below = {places.begin(), end};
        above = {end, places.end()};
    }
    nodes_[node].axis = axis;
    nodes_[node].plane = plane;
    cut(partition, below, first, before);
    nodes_[node].second = nodes_.size();
    cut(partition, above, first + before, ranks - before);
}

int Regions::ownerOf(const Vec3& place) const {
    std::size_t node = 0;
    while (nodes_[node].axis >= 0) {
        node = place[nodes_[node].axis] < nodes_[node].plane ? node + 1 : nodes_[node].second;
    }
    return nodes_[node].rank;
}

void requirePartition(const Partition& partition, int ranks) {
    if (partition.kind != PartitionKind::grid) return;
    const auto [nx, ny, nz] = partition.parts;
    if (nx > 0 && ny > 0 && nz > 0 && std::int64_t{nx} * ny * nz == ranks) return;
    throw InputError(fmt::format("a cut into {}x{}x{} regions is not one for {} ranks; their product must be {}", nx,
                                 ny, nz, ranks, ranks));
}

}  // namespace cairn
