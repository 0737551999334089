// Moves a particle among obstacles by small steps near a surface and by one long straight leap elsewhere.
//
// A leap is safe if it is no longer than the distance to the nearest surface. Near a surface, a small step covers at
// most a fraction of the distances to the barrier and to the repulsor (whose force goes like D^-4), and lasts at most a
// fraction of the contact's own oscillation. Each small step is half a drift, the implicit midpoint rule for m dv/dt =
// F - C v, and half a drift.
#include "engine/obstacles/swept_contact.h"

#include <Eigen/LU>
#include <cmath>

#include "engine/obstacles/barriers.h"
#include "engine/obstacles/contact.h"

namespace engine {
namespace {

/// A small step near an obstacle may cover this fraction of the distances to the barrier and to the repulsor, and may
/// last this fraction of the contact's 1/frequency. Measured: rebounds of 0.01 to 1 kg at 1 to 1000 m/s are within 0.5
/// % of those at a tenth of this fraction.
constexpr double kFraction = 0.07;

/// In a step that covers less than this share of a contact's depth, the contact may act as a force, without small steps
/// along the path. Measured on drops and dams: with half or twice this share the errors change by less than the error
/// of the stepper itself.
constexpr double kResolved = 0.2;

/// Contacts act as explicit forces in steps up to this share of the limit of stability. Chosen: a safe distance from
/// the limit.
constexpr double kStable = 0.5;

/// Largest number of small steps in one time step. Chosen: far more than any contact needs. A particle that is caught
/// between obstacles then stays where it is until the next time step.
constexpr int kMostSteps = 20000;

/// Distance up to which obstacles are looked for around a particle that meets one, in radii beyond those that it
/// touches. Chosen: with half of it a particle looks more often on its way to a wall; with twice of it, at more
/// obstacles.
constexpr double kLookAhead = 8.0;

/// How deep a particle may enter a solid whose repulsor cannot stop it, in radii or half thicknesses. Chosen: a
/// particle that grazes the solid this deep goes on nearly straight, as off a hard surface.
constexpr double kGrazeDepth = 0.1;

/// Largest depth (m) under the surface of a sphere that a particle reaches if it continues straight ahead; infinite for
/// other surfaces.
double depthOfStraightPath(const Surface& surface, const Vec3& velocity) {
    if (surface.curvature == 0.0) return std::numeric_limits<double>::infinity();
    const double radius = 1.0 / surface.curvature;
    const double speedSq = squaredLength(velocity);
    const double normalSpeed = dot(velocity, surface.normal);
    const double sine = std::sqrt(std::max(0.0, 1.0 - normalSpeed * normalSpeed / speedSq));
    return radius - (radius + surface.height) * sine;
}

/// Whether the particle's kinetic energy suffices to reach a depth (m) under the surface against the force of the
/// repulsor.
bool canReach(double depth, const Surface& surface, const Obstacles& obstacles, const Probe& particle) {
    Surface surfaceAtDepth = surface;
    surfaceAtDepth.height = -depth;
    const double kinetic = 0.5 * particle.mass * squaredLength(particle.velocity);
    return kinetic + surfaceEnergy(surface, obstacles, particle) > surfaceEnergy(surfaceAtDepth, obstacles, particle);
}

/// Depth of the reflecting barrier under a face of a paper's wall, m, positive. Under a plane the particle may come as
/// close to the repulsor as the core distance. A solid has a far side, and an off-center hit can miss the repulsor's
/// core: a particle too fast for the repulsor to deflect is stopped at the barrier immediately.
double barrierDepth(const Surface& surface, const Obstacles& obstacles, const Probe& particle) {
    const double radius = particle.radius;
    const double core = obstacles.law.coreFraction * (radius + surface.repulsorRadius);
    const double depth = std::min(std::max(0.0, surface.repulsorRadius - core), 0.9 * surface.halfThickness);
    if (std::isinf(surface.halfThickness)) return depth;
    const double deepest = std::min(depth, depthOfStraightPath(surface, particle.velocity));
    if (!canReach(deepest, surface, obstacles, particle)) return depth;
    return std::min(depth, kGrazeDepth * std::min(radius, surface.halfThickness));
}

/// Bounds on distance and forces of a particle's contacts with obstacles. The lengths `reach` and `scale` are compared
/// with that of a path at `speed`. Where obstacles move, each is therefore the distance from a surface times `speed`
/// over the particle's speed relative to that surface, so that both take the same time.
struct ContactBounds {
    double speed = 0.0;                                    ///< m/s; the particle's own where no obstacle moves
    double gap = std::numeric_limits<double>::infinity();  ///< distance to the nearest surface, negative in contact, m
    double reach = std::numeric_limits<double>::infinity();  ///< the same as the length of a path, m
    double scale = std::numeric_limits<double>::infinity();  ///< shortest length over which contact forces change, m
    double stiffness = 0.0;                                  ///< largest stiffness of a contact, N/m
    double damping = 0.0;                                    ///< largest damping of a contact, kg/s
};

/// The speed of a particle plus the largest speed that an obstacle in motion would have where the particle is, m/s.
/// Only a scale: what is compared with a path at this speed is measured in it, too.
double speedAmong(const Obstacles& obstacles, const Probe& particle) {
    const double own = std::sqrt(squaredLength(particle.velocity));
    if (obstacles.motions.empty()) return own;
    double fastest = 0.0;
    const auto include = [&](std::size_t k) {
        if (particle.time >= obstacles.motions[k].until) return;
        fastest = std::max(fastest, squaredLength(velocityOf(obstacles, k, particle.time, particle.position)));
    };
    if (obstacles.kept.swept.empty()) {
        for (std::size_t k = 0; k < obstacles.motions.size(); ++k)
            if (!obstacles.motions[k].isAtRest()) include(k);
    } else {
        for (const std::uint32_t k : obstacles.kept.inMotion) include(k);
    }
    return own + std::sqrt(fastest);
}

/// Velocity of a particle relative to the face of an obstacle, m/s.
Vec3 velocityToFace(const Probe& particle, const Surface& surface) {
    return surface.motion == nullptr ? particle.velocity : Vec3(particle.velocity - surface.motion->faceVelocity);
}

/// Length over which the force of a paper's wall changes near its surface or its barrier, m, or `known` if that is
/// smaller. The barrier, which is costly to find, is not considered where the scale of the force is far above the path
/// length or above `known`.
[[gnu::always_inline]] inline double paperScale(const Surface& surface, const Obstacles& obstacles,
                                                const Probe& particle, double pathLength, double known) {
    // At worst a step ends this far beyond the barrier, which is still on the near side of the solid.
    const double least = 0.5 * std::min(particle.radius + surface.repulsorRadius, surface.halfThickness);
    const double above = std::min(surface.height, particle.radius);
    const double shallow = std::max(least, above);
    const bool needsBarrier = pathLength > kResolved * shallow && shallow < known;
    const double depth = needsBarrier ? barrierDepth(surface, obstacles, particle) : 0.0;
    return std::min(known, std::max(least, above + depth));
}

/// Length over which the force of a scaled wall changes, m: the distance from the repulsor, at most as at contact.
double scaledScale(const Surface& surface, double radius) {
    return radius + std::clamp(surface.height, 0.0, radius);
}

/// Finds the bounds on a particle's contacts, and calls visit(surface, contact) for each contact. Where the obstacles
/// are many, a gap that is longer than the path and kLookAhead radii is bounded from below.
/// @param duration  of the coming step, s; infinite if it is not known
/// The lambda is forced inline, because most surfaces are far away, and a call takes longer than finding that out.
/// Measured with `globular simulate powder --threads 1`: a twentieth less time.
template <class Visit>
ContactBounds findContactBounds(const Obstacles& obstacles, const Probe& particle, double duration,
                                const Visit& visit) {
    ContactBounds bounds;
    bounds.speed = speedAmong(obstacles, particle);
    const double pathLength = std::isinf(duration) ? duration : duration * bounds.speed;
    const double radius = particle.radius;
    const double ahead = std::isinf(pathLength) ? kLookAhead * radius : std::max(pathLength, kLookAhead * radius);
    const double farthest = largestContactReach(obstacles.index.isWetted, radius);
    const double reach = farthest + ahead;
    const bool arePlaced = !obstacles.motions.empty();
    const double beyond = forEachSurface(
        obstacles, particle.position, particle.time, reach, [&](const Surface& surface) __attribute__((always_inline)) {
            const double gap = surface.height - contactReach(*surface.wall, radius);
            const double longer =
                arePlaced ? bounds.speed / std::sqrt(squaredLength(velocityToFace(particle, surface))) : 1.0;
            bounds.gap = std::min(bounds.gap, gap);
            bounds.reach = std::min(bounds.reach, gap > 0.0 ? longer * gap : gap);
            bounds.scale = obstacles.wall == WallLaw::paper
                               ? paperScale(surface, obstacles, particle, pathLength, bounds.scale)
                               : std::min(bounds.scale, longer * scaledScale(surface, radius));
            if (gap >= 0.0) return;
            const Contact contact = contactWith(surface, obstacles, particle);
            if (contact.isPaper) bounds.scale = std::min(bounds.scale, contact.repulsor.distance);
            bounds.stiffness = std::max(bounds.stiffness, stiffnessAlong(contact));
            bounds.damping = std::max(bounds.damping, dampingAlong(contact));
            visit(surface, contact);
        });
    if (std::isinf(beyond)) return bounds;
    // Obstacles that are left out are scaled walls, since the paper's have no index and do not move, and out of reach:
    // scaledScale() of a surface without contact is two radii.
    bounds.gap = std::min(bounds.gap, beyond - farthest);
    bounds.reach = std::min(bounds.reach, beyond - farthest);
    bounds.scale = std::min(bounds.scale, 2.0 * radius);
    return bounds;
}

/// The longest small step (s) that the bounds on the contacts allow, such that the remaining time (s) is divided
/// evenly.
/// @param hardening  growth of a scaled wall's stiffness with depth, N/m^2
double smallStepFor(const ContactBounds& bounds, double hardening, double mass, double remaining) {
    const double speed = bounds.speed;
    const double leap =
        std::max(bounds.reach, kFraction * std::min(bounds.scale, 0.1 * bounds.scale + std::max(0.0, -bounds.gap)));
    double step = remaining;
    if (speed * step > leap) step = leap / speed;
    const double frequency = std::sqrt(bounds.stiffness / mass);
    if (frequency * step > kFraction) step = kFraction / frequency;
    // The same for the stiffness at the end of the step, where a light particle arrives at a stiff wall.
    const double outside = std::max(0.0, bounds.reach) / speed;
    double inside = std::max(0.0, step - outside);
    const auto loadWithin = [&](double time) { return (bounds.stiffness + hardening * speed * time) * time * time; };
    while (loadWithin(inside) > kFraction * kFraction * mass) inside *= 0.5;
    step = std::min(step, outside + inside);
    return remaining / std::ceil(remaining / step);
}

/// Applies Coulomb friction, at most what stops the slip, and returns its impulse on the particle, N s.
/// @param impulse  that friction may have, N s
Vec3 applyFriction(Probe& particle, const Surface& surface, double impulse) {
    const Vec3 slip = slipVelocity(relativeVelocity(particle, surface), surface.normal);
    const double speed = std::sqrt(squaredLength(slip));
    if (!(speed > 0.0)) return Vec3::Zero();
    const Vec3 change = std::min(1.0, impulse / (particle.mass * speed)) * slip;
    particle.velocity -= change;
    return -particle.mass * change;
}

/// Changes the velocity by the forces of the contacts at the particle's position over a step (s), by the implicit
/// midpoint rule.
void kick(const Obstacles& obstacles, Probe& particle, double step, ContactLoads* loads) {
    Vec3 force = Vec3::Zero();
    Matrix3 damping = Matrix3::Zero();
    const Probe atStart = particle;
    bool isTouched = false;
    std::size_t first = loads == nullptr ? 0 : loads->size();
    forEachTouched(obstacles, atStart.position, atStart.time, atStart.radius, [&](const Surface& surface) {
        const Contact contact = contactWith(surface, obstacles, atStart);
        const double along = dampingAlong(contact);
        force += normalForce(contact, 0.0) * surface.normal;
        damping += along * surface.normal * surface.normal.transpose();
        if (surface.motion != nullptr) force += along * dot(surface.motion->velocity, surface.normal) * surface.normal;
        Vec3 friction = Vec3::Zero();
        if (contact.friction > 0.0)
            friction = applyFriction(particle, surface, contact.friction * pressureForce(contact) * step);
        isTouched = true;
        if (loads != nullptr) recordLoad(surface, friction, obstacles, atStart, *loads);
    });
    if (!isTouched) return;
    Vec3& velocity = particle.velocity;
    const Matrix3 matrix = particle.mass * Matrix3::Identity() + 0.5 * step * damping;
    const Vec3 middle = matrix.inverse() * Vec3(particle.mass * velocity + 0.5 * step * force);
    velocity = 2.0 * middle - velocity;
    if (loads == nullptr || loads->size() == first) return;
    // The same contacts once more, for the loads along their normals, which follow from the velocity in the middle.
    Probe inMiddle = atStart;
    inMiddle.velocity = middle;
    forEachTouched(obstacles, atStart.position, atStart.time, atStart.radius, [&](const Surface& surface) {
        if (!isRecorded(obstacles, surface.obstacle)) return;
        const Contact contact = contactWith(surface, obstacles, atStart);
        const double speed = dot(relativeVelocity(inMiddle, surface), surface.normal);
        (*loads)[first++].impulse += step * normalForce(contact, speed) * surface.normal;
    });
}

/// Keeps the energy of a particle that an obstacle rebounds without loss, in the frame of the obstacle. The small steps
/// err by some thousandths, which elsewhere the damping hides.
class ElasticContact {
 public:
    /// Takes note of a contact at the start of a small step.
    [[gnu::always_inline]] void meet(const Surface& surface, const Contact& contact) {
        now_.count += 1;
        now_.isLossless = !contact.isPaper && contact.damping == 0.0 && contact.friction == 0.0;
        if (!now_.isLossless) return;
        now_.energy = contactEnergy(contact);
        now_.normal = surface.normal;
        now_.velocity = materialVelocity(surface);
        now_.obstacle = surface.obstacle;
    }

    /// Gives the particle the speed along the normal that its energy at the start of the last small step demands, and
    /// begins the next small step. Only where it has touched a single surface that rebounds without loss and does not
    /// accelerate.
    void conserve(const Obstacles& obstacles, Probe& particle, ContactLoads* loads) {
        if (before_.isAlone() || now_.isAlone())
            conserveAlone(obstacles, particle, loads);
        else
            before_.count = 0;
        now_.count = 0;
    }

    /// Whether the last small step began in contact with a surface that rebounds without loss.
    bool isMet() const { return before_.isAlone(); }

 private:
    struct Met {
        int count = 0;
        bool isLossless = true;
        double energy = 0.0;  ///< at the surface, J
        double total = 0.0;   ///< with that of the motion relative to the surface, J
        Vec3 normal = Vec3::UnitY();
        Vec3 velocity = Vec3::Zero();  ///< m/s
        std::size_t obstacle = 0;

        bool isAlone() const { return count == 1 && isLossless; }
    };

    void conserveAlone(const Obstacles& obstacles, Probe& particle, ContactLoads* loads) {
        if (now_.count == 0) now_ = {};
        if (before_.isAlone() && (now_.count == 0 || (now_.isAlone() && now_.velocity == before_.velocity))) {
            const Vec3 normal = now_.count == 1 ? now_.normal : before_.normal;
            const Vec3 velocity = particle.velocity - before_.velocity;
            const double excess = 0.5 * particle.mass * squaredLength(velocity) + now_.energy - before_.total;
            const double along = dot(velocity, normal);
            const double squared = along * along - 2.0 * excess / particle.mass;
            if (squared > 0.0) {
                const Vec3 change = (std::copysign(std::sqrt(squared), along) - along) * normal;
                particle.velocity += change;
                if (loads != nullptr && isRecorded(obstacles, before_.obstacle))
                    loads->push_back(
                        {before_.obstacle, particle.mass * change, particle.position, before_.velocity, particle.time});
            }
        }
        now_.total = now_.energy + 0.5 * particle.mass * squaredLength(particle.velocity - now_.velocity);
        before_ = now_;
    }

    Met before_, now_;
};

/// Reflects a particle that moves on under the barrier of a paper's wall.
void reflectAtBarriers(const Obstacles& obstacles, Probe& particle) {
    Vec3& velocity = particle.velocity;
    forEachSurface(obstacles, particle.position, particle.time, particle.radius, [&](const Surface& surface) {
        if (surface.height >= 0.0 || surface.height >= -barrierDepth(surface, obstacles, particle)) return;
        const double normalSpeed = dot(velocity, surface.normal);
        if (normalSpeed < 0.0) velocity -= 2.0 * normalSpeed * surface.normal;
    });
}

}  // namespace

Contacts contactsInStep(const Obstacles& obstacles, const Probe& particle, double duration, bool isExplicit,
                        ContactLoads* loads) {
    Contacts contacts;
    const ContactBounds bounds =
        findContactBounds(obstacles, particle, duration, [&](const Surface& surface, const Contact& contact) {
            const Vec3 before = contacts.force;
            addForce(surface, contact, particle, contacts.force);
            if (loads != nullptr)
                recordLoad(surface, 0.5 * duration * (contacts.force - before), obstacles, particle, *loads);
        });
    const double pathLength = duration * bounds.speed;
    contacts.gap = bounds.gap;
    contacts.mayTouch = pathLength > bounds.reach;
    // A contact that acts as an explicit force is stable up to h^2 k + 2 h b = 4 m, with k at the end of the step.
    if (!contacts.mayTouch) return contacts;
    const double depth = pathLength - std::max(0.0, bounds.reach);
    const double hardening = obstacles.wall == WallLaw::paper ? 0.0 : hardeningAtContact(obstacles, particle);
    const double load = duration * (duration * (bounds.stiffness + hardening * depth) + 2.0 * bounds.damping);
    contacts.needsSweep = pathLength > kResolved * bounds.scale || (isExplicit && load > kStable * 4.0 * particle.mass);
    return contacts;
}

int advanceThroughContacts(const Obstacles& obstacles, Probe& particle, double duration, ContactLoads* loads) {
    Vec3& position = particle.position;
    const Vec3& velocity = particle.velocity;
    const bool isPaper = obstacles.wall == WallLaw::paper;
    const double hardening = isPaper ? 0.0 : hardeningAtContact(obstacles, particle);
    int hits = 0;
    const auto move = [&](double step) {
        if (isPaper)
            position += step * velocity;
        else
            hits += moveAmongBarriers(obstacles, particle, step, Arrival::rebounds, loads);
    };
    ElasticContact elastic;
    const auto findBounds = [&]() __attribute__((always_inline)) {
        constexpr double kAnyDuration = std::numeric_limits<double>::infinity();
        const ContactBounds bounds = findContactBounds(
            obstacles, particle,
            kAnyDuration, [&](const Surface& surface, const Contact& contact) __attribute__((always_inline)) {
                elastic.meet(surface, contact);
            });
        elastic.conserve(obstacles, particle, loads);
        return bounds;
    };
    const double end = particle.time + duration;
    double remaining = duration;
    for (int count = 0;; ++count) {
        const bool isOver = !(remaining > 0.0) || count == kMostSteps;
        if (isOver && !elastic.isMet()) break;
        const ContactBounds bounds = findBounds();
        if (isOver) break;
        const double speed = bounds.speed;
        // Written so that a NaN speed ends the loop; the check after the step reports it.
        if (!(speed * remaining > bounds.reach) && (bounds.reach > 0.0 || !(speed >= 0.0))) {
            position += remaining * velocity;
            particle.time = end;
            return hits;
        }
        const double step = smallStepFor(bounds, hardening, particle.mass, remaining);
        move(0.5 * step);
        kick(obstacles, particle, step, loads);
        move(0.5 * step);
        if (isPaper) reflectAtBarriers(obstacles, particle);
        remaining = step >= remaining ? 0.0 : remaining - step;
    }
    particle.time = end;
    return hits;
}

}  // namespace engine
