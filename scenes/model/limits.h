// How large a scene may be before someone has to say that it is meant: a slip of the finger shall not take a machine's
// memory or fill its disk.
#pragma once

namespace scenes {

/// Chosen, largest values that pass.
struct Limits {
    double particles = 2e6;         ///< bodies and births together; a particle takes about a kilobyte
    double frames = 1e5;            ///< an hour at 30 a second
    double pixels = 3840.0 * 2160;  ///< of a picture; in final quality one takes about 150 bytes
};

}  // namespace scenes
