// Matrices are inverted in double precision.
#include "render/prepare/skin/ellipsoid.h"

#include <cmath>

namespace render {

namespace {

/// The square root of an upper bound of a matrix' eigenvalues: of the eighth root of the sum of their eighth powers.
float longestAxis(const SymmetricMatrix<double>& spread) {
    const double scale = spread.trace();
    const SymmetricMatrix<double> eighth = squared(squared(squared(spread * (1.0 / scale))));
    return static_cast<float>(std::sqrt(scale * std::sqrt(std::sqrt(std::sqrt(eighth.trace())))));
}

}  // namespace

SymmetricMatrix<float> inFloat(const SymmetricMatrix<double>& m) {
    return {float(m.xx), float(m.yy), float(m.zz), float(m.xy), float(m.xz), float(m.yz)};
}

Ellipsoid ellipsoidOf(const SymmetricMatrix<double>& spread, float peak) {
    return {inFloat(inverse(spread) * double(peak)), longestAxis(spread)};
}

}  // namespace render
