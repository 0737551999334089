// The lists of a view. They lie one after another in two buffers, because a shader has few samplers: whole numbers in
// `lists`, which begins with the place of each list, texels in `listedTexels`. The order is that of ViewList
// (view_buffers.h).
uniform isamplerBuffer lists;
uniform samplerBuffer listedTexels;

const int kSphereBegins = 0;     // tile t lists the entries begins[t] ... begins[t + 1] - 1 of the items
const int kSphereItems = 1;
const int kBoxBegins = 2;        // of each tile
const int kLineBegins = 3;
const int kLineItems = 4;
const int kCasterBegins = 5;     // of each cell of the light's grid
const int kBoxCasterBegins = 6;  // the last list has all boxes
const int kSpheres = 7;          // in view coordinates: center and radius (m)
const int kTileSpheres = 8;      // the sphere of each entry of the items
const int kBoxes = 9;            // three texels a box: low corner, high corner, color
const int kTileBoxes = 10;       // two texels for each box of a tile: low corner, index, high corner, front
const int kLines = 11;           // three texels a line: both ends (pixels), their depths and the width, color
const int kCasters = 12;         // spheres that cast shadows: u, v, height, radius (m)
const int kBoxCasters = 13;      // two texels a box: low corner and greatest height in light space, high corner and 1, or -1
                                 // if its coverage is subtracted

// Where a list begins in its buffer.
int placeOf(int list) {
    return texelFetch(lists, list).x;
}

int numberOf(int list, int index) {
    return texelFetch(lists, placeOf(list) + index).x;
}

vec4 texelOf(int list, int index) {
    return texelFetch(listedTexels, placeOf(list) + index);
}
