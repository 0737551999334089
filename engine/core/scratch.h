// Memory that is kept from one use to the next, so that it need not be allocated again. Between uses its contents mean
// nothing.
#pragma once

#include <utility>

namespace engine {

/// A T that copies do not take over: a copy of the object that it is part of begins with an empty T, or keeps its own.
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
