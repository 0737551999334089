// SIMD code for weight and obstacles, compiled once per instruction set. Each lane holds one particle, and all lanes
// visit the faces of the obstacles one after another. A face that no lane touches, which is the usual case, costs a dot
// product and a comparison.
#include "engine/forces/external_forces.h"

#include <array>
#include <variant>

#include "engine/obstacles/contact.h"
#include "engine/state/probe.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/external_forces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/core/simd_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

// The formulas of the force law, compiled for this instruction set.
#include "engine/force_law/pair_force-inl.h"

/// Force of all obstacles on as many particles as D has lanes. The operations and their order are those of the scalar
/// code in obstacles/obstacle_surfaces.h. Its test mayReach(), which saves work and changes no result, is applied to
/// boxes only.
template <class D>
class SimdContacts {
    using V = hn::Vec<D>;
    static constexpr D kTag{};
    static constexpr std::size_t kMost = hn::MaxLanes(D());
    static_assert(sizeof(Vec3) == 3 * sizeof(double));

 public:
    SimdContacts(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                 std::size_t first)
        : materials_(field.materials),
          obstacles_(field.obstacles),
          law_(field.obstacles.law),
          particles_(particles),
          velocities_(velocities),
          first_(first),
          point_(read(particles.position[first])),
          velocity_(read(velocities[first])),
          radius_(hn::LoadU(kTag, &particles.radius[first])),
          force_{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)} {
        std::array<double, kMost> reach, friction;
        for (std::size_t lane = 0; lane < lanes(); ++lane) {
            const Material& material = field.materials[particles.material[first + lane]];
            reach[lane] = material.dampingReach;
            friction[lane] = material.friction;
        }
        dampingReach_ = hn::LoadU(kTag, reach.data());
        friction_ = hn::LoadU(kTag, friction.data());
        hasFriction_ = !hn::AllTrue(kTag, hn::Eq(friction_, hn::Zero(kTag)));
    }

    static std::size_t lanes() { return hn::Lanes(kTag); }

    static Vector3<V> read(const Vec3& first) {
        Vector3<V> vectors;
        hn::LoadInterleaved3(kTag, first.data(), vectors.x, vectors.y, vectors.z);
        return vectors;
    }

    /// Sum of the forces of the obstacles visited so far, N.
    const Vector3<V>& force() const { return force_; }

    void meet(const Plane& plane) {
        const Vector3<V> normal = all(plane.normal);
        touch(dot(difference(point_, all(plane.point)), normal), normal, law_.radius);
    }

    void meet(const Container& box) {
        const std::array<V, 3> point = {point_.x, point_.y, point_.z};
        for (int axis = 0; axis < 3; ++axis) {
            const V along = point[static_cast<std::size_t>(axis)];
            const Vec3 inwards = Vec3::Unit(axis);
            touch(hn::Sub(along, set(box.minimum[axis])), all(inwards), law_.radius);
            touch(hn::Sub(set(box.maximum[axis]), along), all(-inwards), law_.radius);
        }
    }

    void meet(const Sphere& sphere) {
        const Vector3<V> away = difference(point_, all(sphere.center));
        const V distance = hn::Sqrt(dot(away, away));
        const V height = hn::Sub(distance, set(sphere.radius));
        if (hn::AllFalse(kTag, hn::Lt(height, radius_))) return;
        const auto isApart = hn::Gt(distance, hn::Zero(kTag));
        const Vector3<V> normal{hn::IfThenElseZero(isApart, hn::Div(away.x, distance)),
                                hn::IfThenElse(isApart, hn::Div(away.y, distance), set(1.0)),
                                hn::IfThenElseZero(isApart, hn::Div(away.z, distance))};
        touch(height, normal, sphere.literalRepulsor ? sphere.radius : law_.radius);
    }

    /// A solid with edges and corners: the force on each particle near it is computed by the scalar code.
    template <class Shape>
    void meet(const Shape& shape) {
        std::array<Vec3, kMost> force;
        hn::StoreInterleaved3(force_.x, force_.y, force_.z, kTag, force.front().data());
        for (std::size_t lane = 0; lane < lanes(); ++lane) {
            const std::size_t p = first_ + lane;
            if (!mayReach(shape, particles_.position[p], particles_.radius[p])) continue;
            const Probe probe = probeOf(materials_, particles_, p, velocities_[p], 0.0);
            forEachSurface(shape, probe.position, law_.radius, [&](const Surface& surface) {
                if (surface.height < probe.radius)
                    addForce(surface, contactWith(surface, obstacles_, probe), probe, force[lane]);
            });
        }
        force_ = read(force.front());
    }

 private:
    static V set(double number) { return hn::Set(kTag, number); }
    static Vector3<V> all(const Vec3& vector) { return {set(vector.x()), set(vector.y()), set(vector.z())}; }

    /// Adds the force of a face of an obstacle on the particles that touch it, as addForce() in
    /// obstacles/obstacle_surfaces.h does for one particle.
    /// @param height  signed distances of the particles' centers from the face, m
    void touch(V height, const Vector3<V>& normal, double repulsorRadius) {
        const auto isTouched = hn::Lt(height, radius_);
        if (hn::AllFalse(kTag, isTouched)) return;
        const V restLength = hn::Add(radius_, set(repulsorRadius));
        const V core = hn::Mul(set(law_.coreFraction), restLength);
        const V damping = hn::Mul(set(law_.dampingFactor), dampingReach_);
        const auto constants = repulsorConstants(set(law_.repulsion), damping, restLength, core);
        const V distance = larger(hn::Add(height, set(repulsorRadius)), core);
        const V speed = dot(velocity_, normal);
        addWhere(isTouched, repulsorForce(distance, speed, constants), normal);
        if (!hasFriction_) return;
        const Vector3<V> slip = difference(velocity_, scaled(speed, normal));
        const V pressure = repulsorForce(distance, hn::Zero(kTag), constants);
        const auto isRough = hn::Ne(friction_, hn::Zero(kTag));
        addWhere(hn::And(isTouched, isRough), hn::Neg(slipDamping(friction_, pressure, dot(slip, slip))), slip);
    }

    /// Adds factor * direction to the force on the particles in the lanes of a mask.
    void addWhere(hn::Mask<D> applies, V factor, const Vector3<V>& direction) {
        Vector3<V> sum = force_;
        addScaled(sum, factor, direction);
        force_ = {hn::IfThenElse(applies, sum.x, force_.x), hn::IfThenElse(applies, sum.y, force_.y),
                  hn::IfThenElse(applies, sum.z, force_.z)};
    }

    const std::vector<Material>& materials_;
    const Obstacles& obstacles_;
    const RepulsorLaw& law_;
    const Particles& particles_;
    const std::vector<Vec3>& velocities_;
    std::size_t first_;
    Vector3<V> point_, velocity_;
    V radius_, dampingReach_, friction_;
    bool hasFriction_;
    Vector3<V> force_;
};

template <class D>
void addTo(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities, std::size_t first,
           Vec3& firstForce) {
    constexpr D kTag{};
    SimdContacts<D> contacts(field, particles, velocities, first);
    for (const Obstacle& obstacle : field.obstacles.shapes)
        std::visit([&](const auto& shape) { contacts.meet(shape); }, obstacle);
    const auto mass = hn::LoadU(kTag, &particles.mass[first]);
    auto sum = contacts.read(firstForce);
    const auto add = [&](auto& force, double gravity, auto contact) {
        force = hn::Add(hn::Add(force, hn::Mul(mass, hn::Set(kTag, gravity))), contact);
    };
    add(sum.x, field.gravity.x(), contacts.force().x);
    add(sum.y, field.gravity.y(), contacts.force().y);
    add(sum.z, field.gravity.z(), contacts.force().z);
    hn::StoreInterleaved3(sum.x, sum.y, sum.z, kTag, firstForce.data());
}

void addExternalForcesHere(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                           std::size_t begin, std::size_t end, std::vector<Vec3>& forces) {
    using Many = hn::ScalableTag<double>;
    using One = hn::CappedTag<double, 1>;
    std::size_t p = begin;
    for (; p + hn::Lanes(Many()) <= end; p += hn::Lanes(Many()))
        addTo<Many>(field, particles, velocities, p, forces[p]);
    for (; p < end; ++p) addTo<One>(field, particles, velocities, p, forces[p]);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(addExternalForcesHere);

void addExternalForces(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                       std::size_t begin, std::size_t end, std::vector<Vec3>& forces) {
    if (begin == end) return;
    HWY_DYNAMIC_DISPATCH(addExternalForcesHere)(field, particles, velocities, begin, end, forces);
}

}  // namespace engine

#endif
