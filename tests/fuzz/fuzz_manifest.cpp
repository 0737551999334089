// Any bytes are a manifest or are refused; what is read is written as it was meant.
#include <cstddef>
#include <cstdint>
#include <string>

#include "render/picture/system_error.h"
#include "tools/run/manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const std::string once = tools::encodeManifest(tools::decodeManifest({data, size}, "fuzzed"));
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(once.data());
        if (tools::encodeManifest(tools::decodeManifest({bytes, once.size()}, "again")) != once) __builtin_trap();
    } catch (const render::SystemError&) {
    }
    return 0;
}
