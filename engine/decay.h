// The exponential of the drag, written out because the library's may differ in its last bit from machine to machine.
#pragma once

namespace engine {

/// exp(-rate * duration), for rate (1/s) and duration (s) not negative; the same bits on every machine.
/// Error:  a few units in the last place (compared with std::exp in the tests).
double decayFactor(double rate, double duration);

}  // namespace engine
