// Classes of tiles: those that show the same kinds of things are drawn together, with a program that has only these.
// Used by the picture pass.
#pragma once

namespace render {

/// A tile's class is the sum of what it may show.
enum ClassBit {
    kSphereBit = 1,
    kFieldBit = 2,
    kLineBit = 4,
    kBoxBit = 8,
    kGroundBit = 16,
    kHorizonBit = 32,
    kWholeBit = 64,  ///< metaballs fill it without an outline
    kDimBit = 128,   ///< shadows or openness are looked up
    kClassCount = 256
};

/// Whether something may end within the tile, and then asks for antialiasing.
constexpr bool hasOutlines(int tileClass) {
    constexpr int kEnding = kSphereBit | kFieldBit | kLineBit | kBoxBit | kHorizonBit;
    return (tileClass & kWholeBit) == 0 && (tileClass & kEnding) != 0;
}

/// Whether it shows nothing but background, or ground that nothing dims.
constexpr bool isPlain(int tileClass) {
    return (tileClass & ~kGroundBit) == 0;
}

}  // namespace render
