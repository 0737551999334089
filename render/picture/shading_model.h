// The shading model: what color a point of a surface has, and what light, surface, ground and background it depends on.
// render/cpu/ computes it fast, studies/oracle/ slowly in double precision, and both are written from the text below
// and the comments on the fields. Units and axes are those of view.h.
//
// 1. Color of a point on a surface
//
// n is the unit normal, v the unit vector to the eye, l the one to the light. Products of colors are taken channel by
// channel. The fields of Surface describe the particles; on obstacles and the ground, which are matt, they count as 0.
// A term whose strength is 0 is not computed. Particles are all but the strays of render/prepare/cells/strays.h, which
// neither are seen nor change what is seen.
//
//   h               = normalize(l + v), halfway between the two
//   r               = 2 (n.v) n - v, the direction in which the eye's ray is mirrored
//   mix(a, b, t)    = a (1 - t) + b t
//   skyLight(d)     = mix(ambient.ground, ambient.sky, 0.5 + 0.5 d.y)
//   ambient         = skyLight(n) (1 - occlusion (1 - skyVisibility(n)))            skyVisibility: section 3
//   cosine          = max(0, n.l) (1 + roughness (2.2 / (max(0, n.l) + max(0, n.v) + 0.2) - 1))
//   diffuse         = light.color cosine lightVisibility                            lightVisibility: section 4
//   transmitted     = translucency skyVisibility(-n) (skyLight(-n) + light.color (0.25 + max(0, -n.l)))
//   body            = mix(albedo, albedo^2, absorption (1 - skyVisibility(-n)))
//   fresnel(c)      = f + (1 - f) (1 - max(0, c))^5  with  f = mix(specular, albedo, metal)
//   highlight       = light.color lightVisibility (1 - occlusion (1 - skyVisibility(r))) fresnel(v.h)
//                     (g + 8)/8 max(0, n.h)^g  with  g = 2^glossExponent;
//                     0 where n.l <= 0, and where both specular and metal are 0
//   mirrored        = reflection fresnel(n.v) skyVisibility(r) surroundings(r)
//   rim             = light.rim (1 - max(0, n.v))^4 (0.5 + 0.5 n.y) (1 - occlusion (1 - skyVisibility(n)));
//                     0 on obstacles and the ground
//   surroundings(d) = mix(horizon, top, d.y (2 - d.y)) for d.y > 0, else mix(horizon, bottom, min(1, -4 d.y))
//   color           = (1 - metal) body (ambient + diffuse + transmitted + glowLight(n)) + highlight + rim + mirrored
//                     + glow albedo^2                                               glowLight: section 3
//   displayed       = shoulder(exposure color), or color where exposure is 0
//   shoulder(c)     = c where its largest channel p <= 0.7, else mix(c q/p, q, 1 - 1/(1 + 0.06 (p - q)))
//                     with q = 1 - 0.09/(p - 0.4)
//
// Full roughness is the Lommel-Seeliger law of dust and of the moon, cosine / (n.l + n.v), with 0.2 added against the
// pole at grazing angles and 2.2 to leave a surface seen and lit head-on as bright as it was. fresnel is Schlick's
// approximation (1994), highlight the Blinn-Phong lobe normalized to reflect the same energy at any exponent. Like all
// that is mirrored, it is seen by rays in many directions around r, some of which meet the neighbors: without that
// factor, the narrow crease where two bodies touch, whose normals sweep over all directions, shows a pale line. The
// shoulder compresses what is too bright to display: q has the value 0.7 and the slope 1 at p = 0.7 and stays below 1,
// and the mix turns very bright colors white.
//
// rim is what lighting artists call a rim light: it stands behind and above what the camera looks at, whatever side the
// camera is on, and its light is seen where the surface turns away from the eye.
//
// 2. Background and ground
//
// The background is mix(bottom, top, t), where t runs from 0 at the bottom edge of the picture to 1 at the top edge.
// The ground's color is mixed into the background by fade/(1 + fade), where fade = (d/fadeDistance)^4 and d is the
// distance of the point from the ground's center.
//
// 3. Sky visibility (ambient occlusion) and the light of glowing particles
//
// At a point x, in the direction of a unit vector d,
//   skyVisibility(d) = sum over the axes a = x, y, z of d_a^2 O(x, a, sign of d_a).
// The values O between 0 (hidden) and 1 (open), two along each axis, come from a grid. Space is divided into cubes of
// side s, with corners at multiples of s. s is the smallest power of 2^(1/4) m that is not below twice the particles'
// mean radius; it is doubled until the box around all particles' centers, ten cubes wider on each side, has at most a
// million cubes. Every particle spreads its volume, in units of s^3, over the eight cubes whose centers surround its
// own, by trilinear weights. Blurred with the weights 1/4, 1/2, 1/4 along each axis, that is the density F of a cube.
// In the direction e of one of its six faces a cube has
//   O   = 1/(1 + tau)^2,
//   tau = sum over j = 1...6 of (1 - (j - 1/2)/6) F(j cubes further along e),
// and O(x) is interpolated trilinearly between the centers of the cubes around x + 0.75 s e, a little ahead so that a
// surface does not hide the sky from itself. A particle has the values of its center all over, the surface of metaballs
// the mean of the balls' values weighted by their kernels, obstacles and the ground those of the point itself. Sky is
// seen through metaballs whose medium has a transparency t: for obstacles and the ground O counts as 1 - (1 - t)(1 -
// O).
//
// Particles with glow light what is around them. A particle of radius a has in the direction of a unit vector u the
// intensity glow albedo^2 a^2 skyVisibility(u), with the values O of its center: those inside of a heap emit little.
// Space is divided into cubes of side t = 2 s, with corners at multiples of t. Along each axis, in both directions, the
// intensities are spread over the eight cubes whose centers surround the particle, by trilinear weights. t is doubled
// until at most 1024 cubes emit, and the box around these, six cubes wider on each side, has at most 2^17. Let J(u)
// be the sum over the axes of u_a^2 J(axis a, sign of u_a). A surface in the middle of a cube that faces in the
// direction e of one of its six sides receives
//   I(e) = sum over the cubes that emit of J(u) max(0, -u.e) (1 - d^2/D^2)^2/(d^2 + t^2/4),
// where d and u are distance and direction from the middle of the cube that emits, 0 < d < D = 6 t. This is the inverse
// square of the distance, made finite where it is nothing but a cube, and 0 beyond D. Then, I interpolated trilinearly,
//   glowLight(n) = sum over the axes of n_a^2 I(axis a, sign of n_a).
// Obstacles do not stop this light.
//
// 4. Light visibility (shadows)
//
// lightVisibility is max(0, 1 - C), where C is the sum of what spheres, boxes, meshes and metaballs cover of the light.
// The light's plane is the one across l, and S is the softness of the light. With S > 0,
//   edge(x) = y^2 (3 - 2 y)  with  y = clamp(x + 1/2, 0, 1).
// A sphere of radius R, whose center is at the distance q from the ray to the light and H along it, covers
//   edge((R - q)/w)  with  w = S min(R, max(0, H/2)),
// if H + sqrt(max(0, R^2 - q^2)) > R/100; with 0 in place of R/100, rounding would let a sphere shade itself. A box
// covers
//   edge(x/w)  with  w = S min(mean radius of the particles, E/2),
// where x is the distance on the light's plane from the nearest of the lines through the sides of its outline, positive
// inside, and E the distance at which the ray leaves it. A box behind the point covers nothing.
//
// Boxes that touch or overlap would be counted twice where their outlines meet. Each group of boxes that are connected
// by touching or overlapping ones is therefore joined. First the boxes grow through their neighbors: for one box after
// another, for its faces +x, -x, +y, -y, +z, -z, and for one box of the group after another, a face that lies in that
// box as a whole is moved to the far side of that box, again and again until no face moves. The boxes then fill the
// same space. Those within others are left out, of equal ones all but the first. The group covers the sum of what the
// boxes cover, less that of the intersections of each two, plus that of each three, and so on. Groups of more than 256
// boxes, or with more than 16 terms to a box, are not joined.
//
// Metaballs cover the share of rays to the light that meet them. With t = S/2 mean radii, these rays start around
//   p + 1.5 t n + 0.5 t l,
// p being the point, and are spread over the light's plane with the weights of a quadratic B-spline, 3 t wide, along
// each of the axes u and v of light_space.h. Meshes cover the share of such rays that enter a solid, which start around
// p + 1.5 t |n x l| n. With S = 0 edges are sharp, up to the width of a pixel.
//
// Transparent meshes cover nothing. Of metaballs whose medium has a transparency t, light of each color passes through:
// in place of the share K that they cover, K (1 - t 2^-D) counts.  D is the optical depth of the column of metaballs
// along the light, above the point and below: the sum over all particles, at a distance d from the column's axis, of
//   3 kBodyVolume r^3/(pi R^2) (1 - d^2/R^2)^2 log2(1/C)/A   for d < R = kSplatReach r,
// where r is the particle's radius, C its color, at least kDarkestMedium, and A the attenuation distance. It may be
// interpolated linearly between columns half a mean radius apart, or as many as 1024 along a side allow.
//
// 5. Rounding to 8 bits
//
// At last the picture is clamped to [0, 1] and sRGB encoded, which gives e from 0 to 255. A channel of the pixel in
// column x and row y becomes
//   floor(e + (m + 1/2)/64)  with  m = sum over the bits b = 0, 1, 2 of 4^(2 - b) (2 (x_b xor y_b) + y_b),
// x_b being bit b of x. This is ordered dithering (Bayer 1973): over every 8 x 8 pixels of one color the mean is right
// to 1/128 of a step, so that smooth gradients show no bands. A color that is a whole number of steps is not changed:
// it stays flat. All of the picture is dithered and not only the sky, because the ground, soft shadows and large smooth
// surfaces change as slowly as the sky does. Text and scales, and the layers for compositing, are not.
//
// 6. Transparency
//
// Metaballs and meshes whose Medium has a transparency t above 0 are bodies that light passes through. Where a ray from
// the eye first meets one, its pixel shows
//   own + t W behind.
// own is the displayed color of section 1 with the body multiplied by 1 - t. A transparent mesh has a highlight and
// mirrors its surroundings as a particle does whose specular is h, whose glossExponent is kGlassGloss and whose
// reflection is 1; behind is the displayed color of what the ray meets at last, by sections 1 and 2, and W the share of
// it that arrives. All surfaces on the way but the first are clear, whatever their t.
//
// The ray. At a surface between media with the refractive indices a, on the side where it comes from, and b, let c be
// the cosine of its angle with the normal. It is refracted by Snell's law. The share that is mirrored is F, Schlick's
// approximation, at the angle in the thinner medium:
//   F = h + (1 - h) (1 - c')^5  with  h = ((a - b)/(a + b))^2,  c' = c for a <= b, else sqrt(1 - (a/b)^2 (1 - c^2)).
// The ray goes on with W (1 - F) in place of W. Where it comes from air and has met another surface before, the own of
// that first surface gets W F surroundings(r) in addition, before the exposure. Where Snell's law has no solution, the
// ray is mirrored whole. On a length x through a medium of the color C and the attenuation distance A, W is multiplied
// by C^(x/A) (Beer's law). C is the color of the surface at the point where the ray comes into the medium, but at least
// kDarkestMedium. The ray ends at the first surface that is not transparent, at the ground, or in the background; there
// it shows the background of the row of pixels in which the eye sees its direction, the nearest row if none does, and
// in parallel projection that of its own pixel. It also ends in the background behind its kMostSurfaces-th surface.
// Rays whose W is below kFaintest in all channels may be left out.
//
// The media. Outside of all bodies is air, of index 1. Where a mesh and metaballs overlap, the mesh counts: a glass
// that liquid touches. Particles leave a layer of air between bodies in contact that is none in nature. A layer of air
// on the ray counts as thin if it is less deep than the particles' mean radius, measured across the surface of the
// mesh, obstacle or ground that bounds it, and less long than kLongestLayer of them. Metaballs reach through a thin
// layer to whatever solid is behind or, where the ray comes out of a mesh, before them; a mesh reaches through one to
// an opaque solid or the ground.
#pragma once

#include <cstddef>

#include <glm/glm.hpp>

namespace render {

/// Parallel light.
struct Light {
    glm::vec3 toLight{0.4F, 0.8F, 0.4472136F};  ///< unit length
    glm::vec3 color{1.0F};
    glm::vec3 rim{0.0F};    ///< color of a light behind the particles that brightens their outlines; 0: none
    bool shadows = true;    ///< whether the light casts shadows; without them lightVisibility is 1
    float softness = 0.0F;  ///< about the width of shadows' edges in particle radii, 0 to 1: S in section 4
};

struct Ambient {
    glm::vec3 sky{0.35F};
    glm::vec3 ground{0.2F};
    float occlusion = 0.0F;  ///< strength of ambient occlusion; 1: dark where no sky is visible
};

/// Colors of the surroundings that a mirroring surface reflects, linear RGB.
struct Surroundings {
    glm::vec3 top{0.9F};
    glm::vec3 horizon{0.6F};
    glm::vec3 bottom{0.2F};
};

/// The inside of a body that light passes through, section 6.
struct Medium {
    float transparency = 0.0F;         ///< share of what is behind that shows through the body's surface; 0: opaque
    float refractiveIndex = 1.33F;     ///< above 1; 1.33 is water, 1.5 honey and glass
    float attenuationDistance = 1.0F;  ///< length on which white light takes the body's color, m

    bool isTransparent() const { return transparency > 0.0F; }
    bool operator==(const Medium&) const = default;
};

/// Exponent of two of the exponent of a transparent mesh's highlight.
inline constexpr int kGlassGloss = 10;
/// Least value of a channel of a medium's color, so that Beer's law has a finite attenuation.
inline constexpr float kDarkestMedium = 0.001F;
/// Volume of a body of metaballs for each of its particles, in cubes of the particle's radius: 4/3 pi over the share of
/// space that randomly packed spheres fill, 0.64.
inline constexpr float kBodyVolume = 6.5F;
/// Radius of the kernel with which a particle dims the light of transparent metaballs, in radii of the particle.
/// Chosen: columns of a resting body are even.
inline constexpr float kSplatReach = 2.5F;
/// Number of surfaces of transparent bodies that a ray passes at most.
inline constexpr std::size_t kMostSurfaces = 12;
/// Greatest length of a thin layer of air along a ray, in mean radii of the particles.
inline constexpr float kLongestLayer = 20.0F;
/// Share of the light from behind that is too faint to be seen: a quarter of a step of an 8-bit color.
inline constexpr float kFaintest = 0.001F;

/// How the particles reflect, transmit and emit light. Obstacles and the ground are matt.
struct Surface {
    float specular = 0.0F;      ///< reflectance at normal incidence; 0 is matt
    int glossExponent = 6;      ///< base-2 logarithm of the highlight's exponent
    float reflection = 0.0F;    ///< strength of the mirrored surroundings, times Fresnel's factor
    float metal = 0.0F;         ///< how metallic; at 1 no diffuse light, and reflections have the particle's color
    float roughness = 0.0F;     ///< how dust-like; at 1 as bright at the rim as in the middle
    float translucency = 0.0F;  ///< share of the light from behind that passes through thin parts
    float absorption = 0.0F;    ///< how much the color deepens in thick parts, 0 to 1
    float glow = 0.0F;          ///< emitted light
    Medium medium{};            ///< inside of metaballs
};

/// A horizontal plane that fades into the background with the distance from its center.
struct Ground {
    float height = 0.0F;
    glm::vec3 color{0.6F};
    glm::vec3 center{0.0F};
    float fadeDistance = 30.0F;  ///< distance at which the color is half ground, half background, m
};

/// Colors of the background, a vertical gradient over the whole picture, linear RGB.
struct Background {
    glm::vec3 top{0.0F};
    glm::vec3 bottom{0.0F};

    bool operator==(const Background&) const = default;
};

}  // namespace render
