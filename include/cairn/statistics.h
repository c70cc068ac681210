/// @file What a step reports: stages with their times, counters, overlap and energy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "cairn/types.h"

namespace cairn {

/// The nine stages of a time step, in order. @source thesis Algorithm 6
enum class Stage { events, positions, detection, batches, correction, velocities, resolution, sleeping, output };

/// Number of stages.
inline constexpr std::size_t stage_count = 9;

/// Names of the stages, as in tables, CSV headers and JSON keys.
inline constexpr std::array<std::string_view, stage_count> stage_names = {
    "events", "positions", "detection", "batches", "correction", "velocities", "resolution", "sleeping", "output"};

/// Momentum, energy and contact laws of a step, with the setting `diagnostics` only. The energy of the end is that of
/// the beginning plus all accounts and the error. @source residuals: Le Lidec et al., Contact models in robotics: a
/// comparative analysis, 2023, arXiv:2304.06372
struct Diagnostics {
    Vec3 momentum = Vec3::Zero();               ///< of all dynamic bodies at the end [N·s, W]
    Vec3 angular_momentum = Vec3::Zero();       ///< likewise, about the origin [N·m·s, W]
    Vec3 fixed_impulse = Vec3::Zero();          ///< from fixed bodies and the world by contacts and joints [N·s, W]
    Vec3 fixed_angular_impulse = Vec3::Zero();  ///< likewise, about the origin [N·m·s, W]
    Vec3 force_impulse = Vec3::Zero();          ///< from gravity, applied forces and springs [N·s, W]
    Vec3 force_angular_impulse = Vec3::Zero();  ///< likewise, about the origin [N·m·s, W]
    double momentum_error = 0;                  ///< change that neither fixed bodies nor forces explain [N·s]
    double angular_momentum_error = 0;          ///< likewise; the correction changes it, too [N·m·s]

    double energy = 0;              ///< kinetic and potential energy at the end [J]
    double energy_flight = 0;       ///< error of the motion under gravity; 0 with exact_flight [J]
    double energy_forces = 0;       ///< work of applied forces and springs [J]
    double energy_damping = 0;      ///< of the gravity damping [J]
    double energy_friction = 0;     ///< work of friction, that against rolling included [J]
    double energy_restitution = 0;  ///< work of the contacts along their normals [J]
    double energy_joints = 0;       ///< work of joints, motors included [J]
    double energy_correction = 0;   ///< potential energy by the correction, and what going back on ways takes [J]
    double energy_drives = 0;       ///< of bodies, a frame or a gravity that follow a law [J]
    double energy_sleep = 0;        ///< of bodies that fell asleep [J]
    double energy_error = 0;        ///< what no account explains: rounding, and what the shock propagation takes [J]

    double signorini = 0;    ///< max |λₙ(cₙ − separating speed)| [J]
    double de_saxce = 0;     ///< max |λ·(c + µ‖c_t‖n)|, cₙ as above: complementarity of the cones [J]
    double dissipation = 0;  ///< max ‖(µ|λₙ| − ‖λ_t‖)c_t‖: friction dissipates as much as it can [J]
};

/// One number of Diagnostics, by name.
struct DiagnosticsField {
    /// How several steps become one number.
    enum class Fold { sum, newest, largest };

    std::string_view name;  ///< as in CSV headers and recordings
    std::string_view unit;
    Fold fold;
    double& (*of)(Diagnostics&);
};

/// All numbers, in a fixed order.
std::span<const DiagnosticsField> diagnosticsFields();

/// Counters of one time step, or sums (counters, times) and extremes (overlap) over several.
struct Statistics {
    std::array<double, stage_count> stage_ms{};  ///< wall time per stage [ms]; 0 in a step that changes nothing
    std::int64_t contacts = 0;
    std::int64_t penetrating_contacts = 0;  ///< deeper than the penetration threshold
    std::int64_t corrected_contacts = 0;    ///< of these, brought back within the threshold
    std::int64_t uncorrected_contacts = 0;  ///< of these, left because every candidate was invalid
    std::int64_t displaced_bodies = 0;      ///< moves of bodies by the correction
    std::int64_t global_iterations = 0;     ///< contacts resolved by the global resolution
    std::int64_t shock_iterations = 0;      ///< contacts resolved by the shock propagation
    std::int64_t shock_batches = 0;         ///< batches that needed the shock propagation
    std::int64_t batches = 0;
    std::int64_t largest_batch = 0;  ///< contacts of the largest batch
    std::int64_t asleep = 0;         ///< bodies asleep at the end
    std::int64_t woken = 0;          ///< bodies woken
    double largest_overlap = 0;      ///< after the correction [m]
    double mean_overlap = 0;         ///< over the overlapping contacts, after the correction [m]
    Diagnostics diagnostics;         ///< zero without the setting

    /// Adds another step: sums of counters and times, largest of largest_batch and largest_overlap, and the newer
    /// value of asleep and mean_overlap; diagnostics as their fields say.
    void add(const Statistics& next);
};

}  // namespace cairn
