// Fuzzes decodePng(): any bytes either give a picture or throw SystemError.
#include <cstddef>
#include <cstdint>

#include "render/output/png.h"
#include "render/picture/system_error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const render::Image image = render::decodePng({data, size}, "fuzzed.png");
        if (image.rgb.size() != image.byteCount()) __builtin_trap();
    } catch (const render::SystemError&) {
    }
    return 0;
}
