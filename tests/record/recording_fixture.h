/// @file A small scene with made-up frames.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cairn/recording.h"
#include "temporary_folder.h"

namespace cairn::test {

/// A plane and one body of each other shape.
inline Scene smallScene() {
    Scene scene;
    scene.name = "small";
    scene.duration = 1;
    scene.gravity = Vec3(0, 0, -10);
    scene.materials = {{"granite", 2800}, {"oak", 800}};
    const auto add = [&](const Shape& shape, const char* material, const Vec3& position, const char* name) {
        SceneBody body;
        body.shape = shape;
        body.material = material;
        body.position = position;
        body.name = name;
        scene.bodies.push_back(body);
    };
    add(HalfSpace{}, "granite", Vec3::Zero(), "ground");
    scene.bodies.back().fixed = true;
    add(Box{Vec3(0.2, 0.4, 0.6)}, "oak", Vec3(0, 0, 2), "box");
    add(Sphere{0.25}, "oak", Vec3(1, 0, 2), "ball");
    add(Capsule{0.1, 0.5}, "oak", Vec3(2, 0, 2), "capsule");
    return scene;
}

/// A frame in which every number differs from every other and none is short in decimal.
inline Frame madeUpFrame(std::size_t index, std::size_t bodies) {
    double next = static_cast<double>(index) * 1000 + 1;
    const auto number = [&] { return std::sqrt(next++); };
    const auto vector = [&] { return Vec3(number(), -number(), number()); };
    Frame frame;
    frame.time = static_cast<double>(index) / 30;
    for (std::size_t i = 0; i < bodies; ++i) {
        frame.position.push_back(vector());
        frame.orientation.push_back(Quat(number(), number(), number(), number()).normalized());
        frame.linear_velocity.push_back(vector());
        frame.angular_velocity.push_back(vector());
        frame.asleep.push_back((index + i) % 2 == 0 ? 1 : 0);
    }
    for (double& ms : frame.statistics.stage_ms) ms = number();
    std::int64_t counter = static_cast<std::int64_t>(index) * 100;
    Statistics& s = frame.statistics;
    for (std::int64_t* value : {&s.contacts, &s.penetrating_contacts, &s.corrected_contacts, &s.uncorrected_contacts,
                                &s.displaced_bodies, &s.global_iterations, &s.shock_iterations, &s.shock_batches,
                                &s.batches, &s.largest_batch, &s.asleep, &s.woken}) {
        *value = ++counter;
    }
    s.largest_overlap = number();
    s.mean_overlap = number();
    frame.kinetic_energy = number();
    frame.potential_energy = -number();
    return frame;
}

/// Records made-up frames and closes the file.
inline void recordFrames(const std::filesystem::path& file, std::size_t frames) {
    const Scene scene = smallScene();
    RecordingWriter writer(file, scene, settingsFor(scene));
    for (std::size_t i = 0; i < frames; ++i) writer.append(madeUpFrame(i, scene.bodies.size()));
    writer.close();
}

inline void expectSameFrame(const Frame& got, const Frame& expected) {
    EXPECT_EQ(got.time, expected.time);
    EXPECT_EQ(got.position, expected.position);
    ASSERT_EQ(got.orientation.size(), expected.orientation.size());
    for (std::size_t i = 0; i < expected.orientation.size(); ++i) {
        EXPECT_EQ(got.orientation[i].coeffs(), expected.orientation[i].coeffs());
    }
    EXPECT_EQ(got.linear_velocity, expected.linear_velocity);
    EXPECT_EQ(got.angular_velocity, expected.angular_velocity);
    EXPECT_EQ(got.asleep, expected.asleep);
    EXPECT_EQ(got.kinetic_energy, expected.kinetic_energy);
    EXPECT_EQ(got.potential_energy, expected.potential_energy);
    const Statistics& a = got.statistics;
    const Statistics& b = expected.statistics;
    EXPECT_EQ(a.stage_ms, b.stage_ms);
    EXPECT_EQ(a.contacts, b.contacts);
    EXPECT_EQ(a.penetrating_contacts, b.penetrating_contacts);
    EXPECT_EQ(a.corrected_contacts, b.corrected_contacts);
    EXPECT_EQ(a.uncorrected_contacts, b.uncorrected_contacts);
    EXPECT_EQ(a.displaced_bodies, b.displaced_bodies);
    EXPECT_EQ(a.global_iterations, b.global_iterations);
    EXPECT_EQ(a.shock_iterations, b.shock_iterations);
    EXPECT_EQ(a.shock_batches, b.shock_batches);
    EXPECT_EQ(a.batches, b.batches);
    EXPECT_EQ(a.largest_batch, b.largest_batch);
    EXPECT_EQ(a.asleep, b.asleep);
    EXPECT_EQ(a.woken, b.woken);
    EXPECT_EQ(a.largest_overlap, b.largest_overlap);
    EXPECT_EQ(a.mean_overlap, b.mean_overlap);
}

inline std::string readWhole(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// What an action throws, as text; a failure of the test if it throws nothing or something else.
template <typename Error, typename Action>
std::string messageOf(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace cairn::test
