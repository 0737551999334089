// What to say when memory runs out: what it was for, how much was asked for, and what to change.
#pragma once

#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>

namespace tools {

/// The failure of `new`, which the program throws in place of std::bad_alloc: it knows how much was asked for.
class AllocationError : public std::bad_alloc {
 public:
    explicit AllocationError(std::size_t bytes) : bytes_(bytes) {}
    std::size_t bytes() const { return bytes_; }

 private:
    std::size_t bytes_;
};

/// Memory ran out. The message says all that can be said.
class MemoryError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// The message of a failed allocation.
/// @param purpose  what the memory was for, such as "simulating 1000 particles"; may be empty
/// @param advice   what to change, such as "simulate fewer particles"; may be empty
std::string memoryMessage(const std::bad_alloc& error, const std::string& purpose, const std::string& advice);

/// Returns the result of work().
/// @param purpose  returns what memory is taken for, as memoryMessage() takes it; called only if there is not enough
/// @throws MemoryError if memory runs out, and whatever work() throws
template <class Purpose, class Work>
auto withMemoryFor(const Purpose& purpose, const char* advice, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc& error) {
        throw MemoryError(memoryMessage(error, purpose(), advice));
    }
}

/// withMemoryFor() for the memory that particles take when they are simulated.
template <class Work>
auto withMemoryForParticles(std::size_t count, const Work& work) {
    const auto purpose = [count] { return "simulating " + std::to_string(count) + " particles"; };
    return withMemoryFor(purpose, "simulate fewer particles", work);
}

/// withMemoryFor() for the memory that pictures of this size (pixels) take when they are drawn or encoded.
template <class Work>
auto withMemoryForPictures(int width, int height, const Work& work) {
    const auto purpose = [=] {
        return "drawing pictures of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
    };
    return withMemoryFor(purpose, "choose a smaller --size or --quality draft, or draw fewer particles", work);
}

}  // namespace tools
