/// @file The correction written down as literally as possible, to test the real one against: recursion instead of a
/// queue, a vector per body, every candidate searched to its end. Slow; for small worlds.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "correction/contact_scene.h"

namespace cairn::test {

class ReferenceCorrection {
  public:
    explicit ReferenceCorrection(ContactScene& scene) : scene_(scene) {}

    /// How often the applied corrections did more than move one body along the normal.
    struct Seen {
        int steps_back = 0;   ///< along the velocity
        int handed_on = 0;    ///< to further bodies
        int closed_gaps = 0;  ///< with a displacement shorter than the first
        int chosen_tied = 0;  ///< a step back tried after a normal that moves as many bodies
    };
    const Seen& seen() const { return seen_; }

    CorrectionCounts correct() {
        const double threshold = -scene_.settings.penetration_threshold;
        std::vector<std::uint32_t> list;
        for (std::uint32_t i = 0; i < scene_.contacts.size(); ++i) {
            if (scene_.contacts[i].distance < threshold) list.push_back(i);
        }
        CorrectionCounts counts;
        counts.penetrating = static_cast<std::int64_t>(list.size());
        for (const std::uint32_t i : list) {
            if (scene_.contacts[i].distance >= threshold) continue;
            const std::optional<Result> best = choose(scene_.contacts[i]);
            if (!best) continue;
            apply(*best);
            counts.displaced += static_cast<std::int64_t>(best->displacement.size());
        }
        for (const std::uint32_t i : list) {
            ++(scene_.contacts[i].distance < threshold ? counts.uncorrected : counts.corrected);
        }
        return counts;
    }

  private:
    struct Result {
        BodyIndex other = 0;
        bool along_velocity = false;
        bool valid = true;
        double longest = 0;
        std::map<BodyIndex, Vec3> displacement;
        std::set<std::uint32_t> affected;
    };

    void recurse(BodyIndex x, const Vec3& d_x, Result& result) {  // Algorithm 1 with (2.5.6)
        for (std::uint32_t i = 0; i < scene_.contacts.size(); ++i) {
            const Contact& c = scene_.contacts[i];
            if (c.a != x && c.b != x) continue;
            const BodyIndex y = c.a == x ? c.b : c.a;
            const Vec3 n_xy = c.a == x ? Vec3(-c.normal) : c.normal;
            const double s = d_x.dot(n_xy);
            const double e = c.distance - scene_.remaining();
            if (s > 0 && s > e) {
                if (scene_.kind[y] == BodyKind::fixed || y == result.other) {
                    result.valid = false;
                    return;
                }
                const Vec3 d_y = e > 0 ? Vec3((s - e) / s * d_x) : d_x;
                const auto known = result.displacement.find(y);
                if (known == result.displacement.end() || d_y.norm() > known->second.norm()) {
                    result.displacement[y] = d_y;
                    recurse(y, d_y, result);
                    if (!result.valid) return;
                }
            }
            result.affected.insert(i);
        }
    }

    Result search(BodyIndex x, BodyIndex other, bool along_velocity, const Vec3& displacement) {
        Result result;
        result.other = other;
        result.along_velocity = along_velocity;
        result.displacement[x] = displacement;
        result.longest = displacement.norm();
        recurse(x, displacement, result);
        return result;
    }

    std::optional<Result> choose(const Contact& c) {  // (2.3.1)–(2.3.3), §2.4, §2.5
        const double d_c = c.distance - scene_.remaining();
        std::vector<Result> of_a;
        std::vector<Result> of_b;
        if (scene_.kind[c.a] == BodyKind::dynamic) {
            const Vec3& step = scene_.linear_step[c.a];
            if (step.dot(c.normal) <= d_c) of_a.push_back(search(c.a, c.b, true, -d_c / step.dot(c.normal) * step));
            of_a.push_back(search(c.a, c.b, false, -d_c * c.normal));
        }
        if (scene_.kind[c.b] == BodyKind::dynamic) {
            const Vec3& step = scene_.linear_step[c.b];
            if (step.dot(c.normal) >= -d_c) of_b.push_back(search(c.b, c.a, true, d_c / step.dot(c.normal) * step));
            of_b.push_back(search(c.b, c.a, false, d_c * c.normal));
        }
        const auto velocityAtPoint = [&](BodyIndex x) -> Vec3 {
            return scene_.v[x] + scene_.w[x].cross(c.point - scene_.position[x]);
        };
        const bool a_first = -velocityAtPoint(c.a).dot(c.normal) > velocityAtPoint(c.b).dot(c.normal);
        std::vector<Result> all = a_first ? of_a : of_b;
        for (const Result& result : a_first ? of_b : of_a) all.push_back(result);
        std::optional<Result> best;
        bool tied = false;
        for (const Result& result : all) {
            if (!result.valid) continue;
            const bool fewer = best && result.displacement.size() < best->displacement.size();
            const bool as_few = best && result.displacement.size() == best->displacement.size();
            const bool tie_won = as_few && result.along_velocity && !best->along_velocity;
            if (!best || fewer || tie_won) {
                best = result;
                tied = tie_won;
            }
        }
        seen_.chosen_tied += tied ? 1 : 0;
        return best;
    }

    void apply(const Result& result) {
        const auto displacementOf = [&](BodyIndex x) -> Vec3 {
            const auto found = result.displacement.find(x);
            return found == result.displacement.end() ? Vec3(Vec3::Zero()) : found->second;
        };
        seen_.steps_back += result.along_velocity ? 1 : 0;
        seen_.handed_on += result.displacement.size() > 1 ? 1 : 0;
        for (const auto& [body, displacement] : result.displacement) {
            seen_.closed_gaps += displacement.norm() < 0.999 * result.longest ? 1 : 0;
            scene_.position[body] += displacement;
            if (scene_.asleep[body] != 0) scene_.woken[body] = WakeReason::displaced;
            scene_.asleep[body] = 0;
        }
        for (const std::uint32_t i : result.affected) {  // (2.3.7)
            Contact& c = scene_.contacts[i];
            c.point += 0.5 * (displacementOf(c.a) + displacementOf(c.b));
            c.distance += (displacementOf(c.a) - displacementOf(c.b)).dot(c.normal);
        }
    }

    ContactScene& scene_;
    Seen seen_;
};

}  // namespace cairn::test
