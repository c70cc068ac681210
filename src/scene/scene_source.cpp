#include <algorithm>
#include <utility>

#include "cairn/scene.h"
#include "integration/motion_curve.h"
#include "scene/scene_survey.h"
#include "sharing/body_records.h"
#include "world/step_rate.h"

namespace cairn {
namespace {

/// Of a scene with more bodies so many places are kept, or up to twice as many. What is between them is cut all the
/// same.
constexpr std::size_t enough_places = std::size_t{1} << 16U;

/// Whether lasting things name bodies that move, or all of them move at once.
bool isTied(const Scene& scene) {
    return !scene.springs.empty() || !scene.joints.empty() || !scene.drives.empty() ||
           !scene.filters.exceptions.empty();
}

/// Finds a survey, body by body.
class Surveyor {
  public:
    explicit Surveyor(const Scene& scene) : exponents_(firstGravity(scene).norm()) {
        survey_.can_be_dealt_out = !isTied(scene) && !scene.frame_motion.has_value();
    }

    void add(const SceneBody& body) {
        ++survey_.bodies;
        const bool moves = !body.fixed && !body.motion;
        survey_.can_be_dealt_out &=
            body.position.allFinite() && (!moves || (isSent(body.shape) && body.locked.empty()));
        if (!moves) return;
        exponents_.add(middleExtent(body.shape));
        if (moving_++ % apart_ != 0) return;
        survey_.places.push_back(body.position);
        if (survey_.places.size() == 2 * enough_places) keepHalf();
    }

    SceneSurvey take() {
        survey_.step_exponent = exponents_.median().value_or(0);
        return std::move(survey_);
    }

  private:
    void keepHalf() {
        for (std::size_t i = 0; i < enough_places; ++i) survey_.places[i] = survey_.places[2 * i];
        survey_.places.resize(enough_places);
        apart_ *= 2;
    }

    SceneSurvey survey_;
    StepExponents exponents_;
    std::size_t moving_ = 0;
    std::size_t apart_ = 1;  ///< bodies from one whose place is kept to the next
};

}  // namespace

Vec3 firstGravity(const Scene& scene) {
    if (!scene.gravity_law) return scene.gravity;
    const MotionCurve curve(*scene.gravity_law);
    const std::optional<double> end = curve.end();
    return end ? Vec3(scene.gravity + curve.at(*end).displacement) : scene.gravity;
}

std::vector<SceneEvent> byTime(std::vector<SceneEvent> events) {
    std::ranges::stable_sort(events, {}, &SceneEvent::time);
    return events;
}

SceneSurvey surveyOf(const Scene& scene) {
    Surveyor surveyor(scene);
    for (const SceneBody& body : scene.bodies) surveyor.add(body);
    return surveyor.take();
}

SceneSource::SceneSource(Scene scene)
    : scene_(std::move(scene)), survey_(std::make_shared<const SceneSurvey>(surveyOf(scene_))) {}

SceneSource::SceneSource(Scene scene, Tell tell) : scene_(std::move(scene)), tell_(std::move(tell)) {
    if (isTied(scene_) || !scene_.bodies.empty()) {
        throw InputError(
            "a scene whose bodies are told has neither bodies nor springs, joints, drives or exceptions of pairs "
            "itself; give it as a Scene with all its bodies");
    }
    Surveyor surveyor(scene_);
    tell_([&](const SceneBody& body) { surveyor.add(body); });
    survey_ = std::make_shared<const SceneSurvey>(surveyor.take());
}

void SceneSource::forEachBody(const Take& take) const {
    if (isTold()) {
        tell_(take);
    } else {
        for (const SceneBody& body : scene_.bodies) take(body);
    }
}

Scene SceneSource::whole() const {
    Scene scene = scene_;
    if (isTold()) {
        scene.bodies.reserve(survey_->bodies);
        tell_([&](const SceneBody& body) { scene.bodies.push_back(body); });
    }
    return scene;
}

}  // namespace cairn
