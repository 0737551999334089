// Work memory that is kept from one use to the next, so that it need not be allocated again. Its contents have no
// meaning between uses.
#pragma once

#include <utility>

namespace engine {

/// Wraps a T, for example a vector, that is left out when the object that contains it is copied: copy construction
/// makes an empty T, and copy assignment keeps the old T.
template <class T>
struct Scratch : T {
    Scratch() = default;
    Scratch(const Scratch& /*other*/) : T() {}
    Scratch(Scratch&& other) noexcept : T(std::move(static_cast<T&>(other))) {}
    Scratch& operator=(const Scratch& /*other*/) { return *this; }
    Scratch& operator=(Scratch&& other) noexcept {
        T::operator=(std::move(static_cast<T&>(other)));
        return *this;
    }
    ~Scratch() = default;
};

}  // namespace engine
