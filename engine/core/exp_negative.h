// The exponential function, by which drag reduces velocities. Written out because the last bit of the library's
// function may differ from machine to machine.
#pragma once

namespace engine {

/// exp(-x) for x not negative, the same bits on every machine, within a few units in the last place of the exact value.
/// Halves x until a short series is exact to rounding, then squares the result back.
inline double expNegative(double x) {
    if (x > 745.0) return 0.0;  // exp(-x) is below the smallest double
    int halvings = 0;
    // Squaring doubles the relative error; with x <= 1/8 a drag over one step (x about 0.01) needs none.
    for (; x > 0.125; x *= 0.5) ++halvings;
    // Taylor to x^10/10!: the first term left out is below 0.125^11/11! = 3e-18.
    double sum = 1.0;
    for (int order = 10; order >= 1; --order) sum = 1.0 - sum * x / order;
    for (; halvings > 0; --halvings) sum *= sum;
    return sum;
}

}  // namespace engine
