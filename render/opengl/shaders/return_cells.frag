// Returns what was found for marked cells to where they lie. The depth test lets marked cells through.
#include "cells.glsl"

uniform usampler2DArray markedHits;
uniform isamplerBuffer pixelsOfCells;  // of each cell, row by row: column + row * width in markedHits
uniform vec4 markedGrid;               // as in place.glsl

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    int pixel = texelFetch(pixelsOfCells, cell.x + cell.y * int(markedGrid.y)).x;
    ivec2 at = ivec2(pixel % int(markedGrid.x), pixel / int(markedGrid.x));
    pixel0 = texelFetch(markedHits, ivec3(at, 0), 0);
    pixel1 = texelFetch(markedHits, ivec3(at, 1), 0);
    pixel2 = texelFetch(markedHits, ivec3(at, 2), 0);
    pixel3 = texelFetch(markedHits, ivec3(at, 3), 0);
}
