// The numbers of a view that all pixels share, as a uniform block. FRAME_FIELDS(X) is X(name) for each of them.
//   image:               2 / width, 2 / height, half the width and half the height of what the picture shows (m)
//   right:               the camera's axes; w: width of a pixel (m), at view depth 1 in perspective
//   up:                  w: 1 / height in pixels
//   forward:             w: height of the ground over the eye (m)
//   toLight:             w: softness of the light
//   lightU:              axes of the light's plane; w: mean radius of the particles (m)
//   lightV:              as lightU, across it; w: as skyBelow's, along the picture's height
//   lightColor:          w: exposure
//   sky:                 ambient light from above; w: strength of ambient occlusion
//   skyBelow:            ambient light from below; w: shift of the picture's middle along its width (m)
//   surface:             specular, reflection, metal, roughness
//   body:                translucency, absorption, glow, normalization (g + 8) / 8 of the highlight
//   surroundingsTop:     colors that mirrors reflect, as the next two; w of the three: color of the rim light
//   surroundingsHorizon:
//   surroundingsBottom:
//   backgroundTop:       colors of the gradient, as the next
//   backgroundBottom:
//   groundColor:         linear RGB, as all colors
//   groundCenter:        w: 1 / distance at which the ground is half faded (1/m)
//   lightCells:          origin of the grid of shadow casters on the light's plane (m), 1 / side of a cell (1/m)
//   boxCells:            origin of the grid of boxes that cast shadows (m), 1 / side of a cell (1/m); w: widest pixel
//                        for which the lists of its cells are complete (m)
//   skyCells:            center of the first cube of the sky visibility (m), 1 / side of a cube (1/m)
//   glowCells:           center of the first cube of the particles' light (m), 1 / side of a cube (1/m)
//   depthMapGrid:        origin of the metaballs' depth map on the light's plane (m), side of a texel (m), its top (m)
//   depthMapSize:        columns and rows of its texels, 1 / its height (1/m); w: greatest reach of a metaball (m)
//   sampleOffset:        of a single sample from the middle of the pixel (pixels); z: depth by which neighboring
//                        points of smooth metaballs differ at most (m); w: field beside which there is no surface
//   lightCellCount:      columns and rows of the grid of lightCells, then of that of boxCells
//   skyCellCount:        number of cubes along each axis
//   glowCellCount:       as skyCellCount, of the cubes of glowCells
//   metaballs:           threshold of the field, spacing of its samples on a ray (m), smallest radius (m), and how near
//                        the field may come to the threshold between samples before it is sampled more densely
//   counts:              index of the first sphere that is no particle, squarings of the highlight, boxes
//                        that cast shadows
#define FRAME_FIELDS(X) \
    X(image) X(right) X(up) X(forward) X(toLight) X(lightU) X(lightV) X(lightColor) X(sky) X(skyBelow) \
    X(surface) X(body) X(surroundingsTop) X(surroundingsHorizon) X(surroundingsBottom) X(backgroundTop) \
    X(backgroundBottom) X(groundColor) X(groundCenter) X(lightCells) X(boxCells) X(skyCells) X(glowCells) \
    X(depthMapGrid) X(depthMapSize) X(sampleOffset) X(lightCellCount) X(skyCellCount) X(glowCellCount) \
    X(metaballs) X(counts)

#define BLOCK_FIELD(name) vec4 name;
layout(std140) uniform Frame {
    FRAME_FIELDS(BLOCK_FIELD)
} frame;
