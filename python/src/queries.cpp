/// Questions about shapes where they are.
#include "arrays.h"
#include "parts.h"
#include "record.h"
#include "world_class.h"

namespace cairn::python {

namespace {

void bindHits(py::module_& module) {
    Record<Ray>(module, "Ray", "A half line, or a line with an end.")
        .field("origin", &Ray::origin, "[m, W]")
        .field("direction", &Ray::direction, "[W], of any length but zero.")
        .field("reach", &Ray::reach, "Farthest distance of a hit [m], ≥ 0.")
        .finish();
    Record<SurfaceHit>(module, "SurfaceHit",
                       "Where a ray first meets a shape; one that begins inside has the distance 0.")
        .field("distance", &SurfaceHit::distance, "From the origin of the ray [m].")
        .field("point", &SurfaceHit::point, "[m, W]")
        .field("normal", &SurfaceHit::normal, "Of the surface: unit, outward, W.")
        .field("part", &SurfaceHit::part, "Index in Compound.parts.")
        .finish();
    Record<ShapeHit>(module, "ShapeHit",
                     "Where a shape that moves without turning first touches another; those that touch at the "
                     "beginning have the distance 0.")
        .field("distance", &ShapeHit::distance, "That the moving shape goes until then [m].")
        .field("point", &ShapeHit::point, "On the other shape [m, W]; one of many where faces or edges touch.")
        .field("normal", &ShapeHit::normal, "Unit, from the other shape to the moving one, W.")
        .field("moving_part", &ShapeHit::moving_part, "Of the moving shape.")
        .field("part", &ShapeHit::part, "Of the other shape.")
        .finish();
    Record<RayHit, SurfaceHit>(module, "RayHit", "A body that a ray hits.")
        .inherited("distance", &RayHit::distance)
        .inherited("point", &RayHit::point)
        .inherited("normal", &RayHit::normal)
        .inherited("part", &RayHit::part)
        .field("body", &RayHit::body, "Which one.")
        .finish();
    Record<BodyHit, ShapeHit>(module, "BodyHit", "A body that a moving shape hits.")
        .inherited("distance", &BodyHit::distance)
        .inherited("point", &BodyHit::point)
        .inherited("normal", &BodyHit::normal)
        .inherited("moving_part", &BodyHit::moving_part)
        .inherited("part", &BodyHit::part)
        .field("body", &BodyHit::body, "Which one.")
        .finish();
}

void bindPlaces(py::module_& module) {
    using P = ClosestPoints;
    Record<P>(module, "ClosestPoints", "The points in which two shapes are closest, or overlap deepest.")
        .field("distance", &P::distance, "Along the normal [m]; negative = overlap.")
        .field("on_a", &P::on_a, "On the surface of A [m, W].")
        .field("on_b", &P::on_b, "On the surface of B [m, W].")
        .field("normal", &P::normal, "Unit, from B to A, W.")
        .field("part_a", &P::part_a, "Of A.")
        .field("part_b", &P::part_b, "Of B.")
        .finish();
    using C = ShapeContact;
    Record<C>(module, "ShapeContact", "One point in which two shapes touch, as a step of the world finds it.")
        .field("point", &C::point, "Halfway between the surfaces [m, W].")
        .field("normal", &C::normal, "Unit, from B to A, W.")
        .field("distance", &C::distance, "Along the normal [m]; negative = overlap.")
        .field("part_a", &C::part_a, "Of A.")
        .field("part_b", &C::part_b, "Of B.")
        .finish(5);
    Record<Overlap>(module, "Overlap", "A part of a body that overlaps a shape.")
        .field("body", &Overlap::body, "Which one.")
        .field("part", &Overlap::part, "Of the body.")
        .finish();
    Record<NearBody>(module, "NearBody", "A body near a shape.")
        .field("body", &NearBody::body, "Which one.")
        .field("closest", &NearBody::closest, "A is the shape, B the body.")
        .finish();
}

void bindFunctions(py::module_& module) {
    module.def("cast_ray", &castRay, py::arg("shape"), py::arg("pose"), py::arg("ray"),
               "Where a ray meets a shape; pose: of the shape in W. Raises InputError.");
    module.def("cast_shape", &castShape, py::arg("moving"), py::arg("pose"), py::arg("way"), py::arg("other"),
               py::arg("other_pose"),
               "Where a shape that moves from its pose along a way [m, W], at whose end it stops, touches another. "
               "Raises InputError.");
    module.def("overlap", &overlap, py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
               "Whether two shapes have a point in common. Raises InputError.");
    module.def("closest_points", &closestPoints, py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
               "Closest points and signed distance of two shapes. Raises InputError.");
    module.def("contacts_of", &contactsOf, py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
               py::arg("margin"),
               "The contacts of two shapes up to a distance [m], by part of A and then of B. Raises InputError.");
}

/// Adds a question about bodies, which says by name what bodies it is not about and what groups it is about.
/// @param answer takes the world, the filter and then the arguments of the question
template <class Result, class... Arguments, class... Names>
void bindQuestion(WorldClass& world, const char* name,
                  Result (*answer)(const PyWorld&, const QueryFilter&, Arguments...), const char* doc, Names... names) {
    world.def(
        name,
        [answer](const PyWorld& self, Arguments... arguments, const py::object& excluding,
                 const std::vector<GroupId>& groups) {
            const std::vector<BodyId> ids = idsFrom(excluding);
            return answer(self, QueryFilter{ids, groups}, std::forward<Arguments>(arguments)...);
        },
        names..., py::kw_only(), py::arg("excluding") = py::tuple(), py::arg("groups") = py::tuple(), doc);
}

std::optional<RayHit> rayHit(const PyWorld& self, const QueryFilter& filter, const Ray& ray) {
    return self.use().castRay(ray, filter);
}

std::vector<RayHit> rayHits(const PyWorld& self, const QueryFilter& filter, const Ray& ray) {
    return self.use().castRayThrough(ray, filter);
}

std::vector<std::optional<RayHit>> hitsOfRays(const PyWorld& self, const QueryFilter& filter,
                                              const std::vector<Ray>& rays) {
    const World& world = self.use();
    return self.owner->alone([&] { return world.castRays(rays, filter); });
}

std::optional<BodyHit> bodyHit(const PyWorld& self, const QueryFilter& filter, const Shape& shape, const Pose& pose,
                               const Vec3& way) {
    return self.use().castShape(shape, pose, way, filter);
}

std::vector<Overlap> overlapsOfShape(const PyWorld& self, const QueryFilter& filter, const Shape& shape,
                                     const Pose& pose) {
    return self.use().overlap(shape, pose, filter);
}

std::vector<Overlap> overlapsOfBox(const PyWorld& self, const QueryFilter& filter, const Vec3& lower,
                                   const Vec3& upper) {
    return self.use().overlap(lower, upper, filter);
}

std::vector<NearBody> nearBodies(const PyWorld& self, const QueryFilter& filter, const Shape& shape, const Pose& pose,
                                 double reach) {
    return self.use().closestPoints(shape, pose, reach, filter);
}

}  // namespace

void bindQueryRecords(py::module_& module) {
    bindHits(module);
    bindPlaces(module);
    bindFunctions(module);
}

void bindQueries(WorldClass& world) {
    using py::arg;
    bindQuestion(world, "cast_ray", &rayHit,
                 "The nearest body that a ray hits; of several at one distance that with the lowest id. Raises "
                 "InputError.",
                 arg("ray"));
    bindQuestion(world, "cast_ray_through", &rayHits,
                 "All parts of bodies that a ray hits, by distance, body and part. Raises InputError.", arg("ray"));
    bindQuestion(world, "cast_rays", &hitsOfRays,
                 "As cast_ray() for each ray, on the threads of the world and without the interpreter's lock. Raises "
                 "InputError.",
                 arg("rays"));
    bindQuestion(world, "cast_shape", &bodyHit,
                 "The first body that a shape meets which moves without turning from a pose along a way [m, W]. "
                 "Raises InputError.",
                 arg("shape"), arg("pose"), arg("way"));
    bindQuestion(world, "overlap", &overlapsOfShape,
                 "The parts of bodies that have a point in common with a shape, or with a box along the axes of W of "
                 "given corners [m, W], by body and part. Raises InputError.",
                 arg("shape"), arg("pose"));
    bindQuestion(world, "overlap", &overlapsOfBox, "", arg("lower"), arg("upper"));
    bindQuestion(world, "closest_points", &nearBodies,
                 "The bodies within reach [m] of a shape, by distance and body; or the closest points of two bodies. "
                 "Raises InputError, StaleIdError.",
                 arg("shape"), arg("pose"), arg("reach"));
    world.def(
        "closest_points", [](const PyWorld& self, BodyId a, BodyId b) { return self.use().closestPoints(a, b); },
        arg("a"), arg("b"));
}

}  // namespace cairn::python
