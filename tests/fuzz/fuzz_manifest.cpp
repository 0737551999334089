// Fuzzes the reader of manifests: any bytes are either rejected, or are a manifest that is the same after it was
// written and read again.
#include <cstddef>
#include <cstdint>
#include <string>

#include "render/picture/system_error.h"
#include "tools/frames/manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const std::string once = tools::encodeManifest(tools::decodeManifest({data, size}, "fuzzed"));
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(once.data());
        if (tools::encodeManifest(tools::decodeManifest({bytes, once.size()}, "again")) != once) __builtin_trap();
    } catch (const render::SystemError&) {
    }
    return 0;
}
