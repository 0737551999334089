// Classes of tiles: those that show the same kinds of things are drawn together, with a program that has only these.
// Used by the picture pass.
#pragma once

#include <bit>

namespace render {

/// A tile's class is the sum of what its pixels show.
enum ClassBit {
    kSphereBit = 1,
    kFieldBit = 2,
    kBoxBit = 4,
    kGroundBit = 8,
    kBackgroundBit = 16,
    kLineBit = 32,
    kDimBit = 64,  ///< shadows or openness are looked up
    kClassCount = 128
};

/// Whether it shows nothing but background, or ground that nothing dims.
constexpr bool isPlain(int tileClass) {
    return tileClass == kBackgroundBit || tileClass == kGroundBit;
}

/// Whether its pixels all show the same kind of thing, which is not background.
constexpr bool showsOneKind(int tileClass) {
    const int kinds = tileClass & (kSphereBit | kFieldBit | kBoxBit | kGroundBit | kBackgroundBit);
    return std::has_single_bit(static_cast<unsigned>(kinds)) && kinds != kBackgroundBit;
}

}  // namespace render
