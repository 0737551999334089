// Replaces the operators new and delete of the program, because the exception of the standard library's does not say
// how much memory was asked for. A file of its own, so that the compiler does not inline them.
#include <cstdlib>
#include <new>

#include "tools/system/memory.h"

void* operator new(std::size_t bytes) {
    if (void* const memory = std::malloc(bytes)) return memory;
    throw tools::AllocationError(bytes);
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
    const auto unit = static_cast<std::size_t>(alignment);
    if (void* const memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit)) return memory;
    throw tools::AllocationError(bytes);
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t /*bytes*/) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
