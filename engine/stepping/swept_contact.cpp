// Small steps near obstacles, one leap elsewhere.
//
// A leap is safe as long as it is no longer than the distance to the nearest surface. Near one, a step covers at most a
// fraction of the way to the barrier and to the repulsor (the force goes like D^-4), and lasts at most a fraction of
// the contact's own oscillation. Each is half a drift, the implicit midpoint of m dv/dt = F - C v, half a drift.
#include "engine/stepping/swept_contact.h"

#include <Eigen/LU>

#include "engine/law/obstacle_surfaces.h"

namespace engine {
namespace {

/// Fraction of the distances above that a small step may cover, and of the contact's 1/frequency that it may last.
/// Measured: rebounds of 0.01 to 1 kg at 1 to 1000 m/s are within 0.5 % of those at a tenth of it.
constexpr double kFraction = 0.1;

/// A step that covers less of a contact's depth needs no sweep. Measured on drops and dams: half or twice as much
/// changes errors by less than the stepper's own.
constexpr double kResolved = 0.2;

/// Share of the limit of stability up to which contacts act as explicit forces. Chosen.
constexpr double kStable = 0.5;

/// Chosen: nothing sane needs as many; a particle caught between obstacles waits there for its next step.
constexpr int kMostSteps = 20000;

/// How deep, in radii or half thicknesses, a particle comes into a solid whose repulsor cannot stop it. Chosen: what
/// grazes that deep goes on nearly straight, as off a hard surface.
constexpr double kGraze = 0.1;

Probe probeOf(const Flight& flight) {
    return {flight.position, flight.velocity, flight.radius, flight.dampingReach, flight.friction};
}

/// How deep the straight way ahead leads, m.
double depthOfWay(const Surface& surface, const Vec3& velocity) {
    if (surface.curvature == 0.0) return std::numeric_limits<double>::infinity();
    const double radius = 1.0 / surface.curvature;
    const double speedSq = squaredLength(velocity);
    const double inwards = dot(velocity, surface.normal);
    const double sine = std::sqrt(std::max(0.0, 1.0 - inwards * inwards / speedSq));
    return radius - (radius + surface.height) * sine;
}

/// Whether the particle has the energy to get to a depth (m) against the repulsor.
bool canReach(double depth, const Surface& surface, const RepulsorLaw& law, const Flight& flight) {
    Surface there = surface;
    there.height = -depth;
    const double kinetic = 0.5 * flight.mass * squaredLength(flight.velocity);
    const Probe probe = probeOf(flight);
    return kinetic + surfaceEnergy(surface, law, probe) > surfaceEnergy(there, law, probe);
}

/// How deep a particle may come, as a positive depth under the face, m. A solid has a far side, and a shot beside its
/// middle may go by the repulsor's core: one that the repulsor cannot keep from its way meets the barrier at once.
double barrierDepth(const Surface& surface, const RepulsorLaw& law, const Flight& flight) {
    const double core = law.coreFraction * (flight.radius + surface.repulsorRadius);
    const double depth = std::min(std::max(0.0, surface.repulsorRadius - core), 0.9 * surface.halfThickness);
    if (std::isinf(surface.halfThickness)) return depth;
    if (!canReach(std::min(depth, depthOfWay(surface, flight.velocity)), surface, law, flight)) return depth;
    return std::min(depth, kGraze * std::min(flight.radius, surface.halfThickness));
}

/// What lies ahead of a particle.
struct Outlook {
    double gap = std::numeric_limits<double>::infinity();    ///< to the nearest surface, m; negative in contact
    double scale = std::numeric_limits<double>::infinity();  ///< length over which contact forces change, m
    double stiffness = 0.0;                                  ///< the largest of the contacts', N/m
    double damping = 0.0;                                    ///< the largest of theirs, kg/s
};

/// way: of the coming step, m. The barrier, which takes longer to tell, is left out where the scale is far above the
/// way or another surface has a smaller one. Calls visit(surface, contact) for each contact.
/// What is done for a surface is inline by force: most are far, and a call takes longer than to see that. Measured with
/// `globular simulate powder --threads 1`: a twentieth less time.
template <class Visit>
Outlook lookAhead(const Obstacles& obstacles, const Flight& flight, double way, const Visit& visit) {
    Outlook ahead;
    forEachSurface(
        obstacles, flight.position, [&](const Surface& surface) __attribute__((always_inline)) {
            const double gap = surface.height - flight.radius;
            ahead.gap = std::min(ahead.gap, gap);
            // At worst a step ends this share of half the thickness beyond the barrier: still on the near side.
            const double least = 0.5 * std::min(flight.radius + surface.repulsorRadius, surface.halfThickness);
            const double above = std::min(surface.height, flight.radius);
            const double shallow = std::max(least, above);
            const bool isBarrierAsked = way > kResolved * shallow && shallow < ahead.scale;
            const double depth = isBarrierAsked ? barrierDepth(surface, obstacles.law, flight) : 0.0;
            ahead.scale = std::min(ahead.scale, std::max(least, above + depth));
            if (gap >= 0.0) return;
            const Contact contact = contactWith(surface, obstacles.law, probeOf(flight));
            ahead.scale = std::min(ahead.scale, contact.distance);
            ahead.stiffness = std::max(ahead.stiffness, stiffnessAlong(contact));
            ahead.damping = std::max(ahead.damping, dampingAlong(contact));
            visit(surface, contact);
        });
    return ahead;
}

/// The longest step that lookAhead allows, s.
double stepFor(const Outlook& ahead, const Flight& flight, double speed, double remaining) {
    const double leap =
        std::max(ahead.gap, kFraction * std::min(ahead.scale, 0.1 * ahead.scale + std::max(0.0, -ahead.gap)));
    double step = remaining;
    if (speed * step > leap) step = leap / speed;
    const double frequency = std::sqrt(ahead.stiffness / flight.mass);
    if (frequency * step > kFraction) step = kFraction / frequency;
    return remaining / std::ceil(remaining / step);
}

/// Coulomb friction: an impulse (N s) against the slip, at most what stops it.
void brake(Flight& flight, const Vec3& normal, double impulse) {
    const Vec3 slip = flight.velocity - dot(flight.velocity, normal) * normal;
    const double speed = std::sqrt(squaredLength(slip));
    if (speed > 0.0) flight.velocity -= std::min(1.0, impulse / (flight.mass * speed)) * slip;
}

/// The implicit midpoint kick of the contacts at the flight's position.
void kick(const Obstacles& obstacles, Flight& flight, double step) {
    Vec3 force = Vec3::Zero();
    Matrix3 damping = Matrix3::Zero();
    const Probe probe = probeOf(flight);
    bool touched = false;
    forEachTouched(obstacles, flight.position, flight.radius, [&](const Surface& surface) {
        const Contact contact = contactWith(surface, obstacles.law, probe);
        force += normalForce(contact, 0.0) * surface.normal;
        damping += dampingAlong(contact) * surface.normal * surface.normal.transpose();
        if (flight.friction > 0.0) brake(flight, surface.normal, flight.friction * normalForce(contact, 0.0) * step);
        touched = true;
    });
    if (!touched) return;
    const Matrix3 matrix = flight.mass * Matrix3::Identity() + 0.5 * step * damping;
    const Vec3 middle = matrix.inverse() * Vec3(flight.mass * flight.velocity + 0.5 * step * force);
    flight.velocity = 2.0 * middle - flight.velocity;
}

void reflectAtBarriers(const Obstacles& obstacles, Flight& flight) {
    forEachSurface(obstacles, flight.position, [&](const Surface& surface) {
        if (surface.height >= 0.0 || surface.height >= -barrierDepth(surface, obstacles.law, flight)) return;
        const double inwards = dot(flight.velocity, surface.normal);
        if (inwards < 0.0) flight.velocity -= 2.0 * inwards * surface.normal;
    });
}

}  // namespace

Contacts contactsAhead(const Obstacles& obstacles, const Flight& flight, double duration, bool isExplicit) {
    const Probe probe = probeOf(flight);
    const double way = duration * std::sqrt(squaredLength(flight.velocity));
    Contacts contacts;
    const Outlook ahead = lookAhead(obstacles, flight, way, [&](const Surface& surface, const Contact& contact) {
        addForce(surface, contact, probe, contacts.force);
    });
    contacts.gap = ahead.gap;
    // The limit is h^2 k + 2 h b = 4 m.
    const double load = duration * (duration * ahead.stiffness + 2.0 * ahead.damping);
    contacts.needsSweep =
        way > ahead.gap && (way > kResolved * ahead.scale || (isExplicit && load > kStable * 4.0 * flight.mass));
    return contacts;
}

void fly(const Obstacles& obstacles, Flight& flight, double duration) {
    double remaining = duration;
    for (int count = 0; remaining > 0.0 && count < kMostSteps; ++count) {
        const double speed = std::sqrt(squaredLength(flight.velocity));
        constexpr double kAnyWay = std::numeric_limits<double>::infinity();
        const Outlook ahead = lookAhead(obstacles, flight, kAnyWay, [](const Surface&, const Contact&) {});
        // Written so that a speed that is not a number ends the flight; the check after the step reports it.
        if (!(speed * remaining > ahead.gap) && (ahead.gap > 0.0 || !(speed >= 0.0))) {
            flight.position += remaining * flight.velocity;
            return;
        }
        const double step = stepFor(ahead, flight, speed, remaining);
        flight.position += 0.5 * step * flight.velocity;
        kick(obstacles, flight, step);
        flight.position += 0.5 * step * flight.velocity;
        reflectAtBarriers(obstacles, flight);
        remaining = step >= remaining ? 0.0 : remaining - step;
    }
}

}  // namespace engine
