// Symmetric 3 x 3 matrices: the shapes of the ellipsoids of an anisotropic skin. Used by the preparation of a view, by
// what casts rays and by the mesh of the surface.
#pragma once

#include <glm/glm.hpp>

namespace render {

/// A symmetric matrix by its six different entries.
template <typename Number>
struct SymmetricMatrix {
    Number xx{}, yy{}, zz{}, xy{}, xz{}, yz{};

    /// The product with a vector of any type that has x, y and z.
    template <typename Vector>
    Vector times(const Vector& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
    }

    Number trace() const { return xx + yy + zz; }

    Number determinant() const {
        return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    }

    SymmetricMatrix operator*(Number factor) const {
        return {xx * factor, yy * factor, zz * factor, xy * factor, xz * factor, yz * factor};
    }

    bool operator==(const SymmetricMatrix&) const = default;
};

/// The square of a matrix, which is symmetric, too.
template <typename Number>
SymmetricMatrix<Number> squared(const SymmetricMatrix<Number>& m) {
    return {m.xx * m.xx + m.xy * m.xy + m.xz * m.xz, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
            m.xz * m.xz + m.yz * m.yz + m.zz * m.zz, m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
            m.xx * m.xz + m.xy * m.yz + m.xz * m.zz, m.xy * m.xz + m.yy * m.yz + m.yz * m.zz};
}

/// The inverse of a matrix whose determinant is not zero.
template <typename Number>
SymmetricMatrix<Number> inverse(const SymmetricMatrix<Number>& m) {
    const SymmetricMatrix<Number> adjugate{m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz,
                                           m.xx * m.yy - m.xy * m.xy, m.xz * m.yz - m.xy * m.zz,
                                           m.xy * m.yz - m.xz * m.yy, m.xy * m.xz - m.xx * m.yz};
    return adjugate * (Number(1) / m.determinant());
}

/// A matrix in the coordinates along three axes of unit length that are at right angles.
template <typename Number, typename Vector>
SymmetricMatrix<Number> inAxes(const SymmetricMatrix<Number>& m, const Vector& x, const Vector& y, const Vector& z) {
    const Vector alongX = m.times(x);
    const Vector alongY = m.times(y);
    const Vector alongZ = m.times(z);
    return {dot(x, alongX), dot(y, alongY), dot(z, alongZ), dot(y, alongX), dot(z, alongX), dot(z, alongY)};
}

}  // namespace render
