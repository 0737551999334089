// Fuzzes the reader of particle files: any bytes are either rejected or are particles.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scenes/model/particle_file.h"
#include "scenes/text/input_error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        scenes::decodeParticles(bytes, "fuzzed.ply");
        scenes::decodeState(bytes, "fuzzed.ply");
    } catch (const scenes::InputError&) {
    }
    return 0;
}
