// oneTBB's allocator of memory that begins with a cache line. See threads.h.
#pragma once

#include <cstddef>
#include <new>

namespace tbb {

template <class T>
struct cache_aligned_allocator {
    using value_type = T;

    cache_aligned_allocator() = default;
    template <class Other>
    cache_aligned_allocator(const cache_aligned_allocator<Other>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
    void deallocate(T* memory, std::size_t) { ::operator delete(memory, kLine); }

    friend bool operator==(const cache_aligned_allocator&, const cache_aligned_allocator&) { return true; }

 private:
    static constexpr std::align_val_t kLine{128};
};

}  // namespace tbb
