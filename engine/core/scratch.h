// Memory that is kept from one use to the next, so that it need not be asked for again, and holds nothing in between
// that anybody needs.
#pragma once

#include <utility>

namespace engine {

/// A T that is not copied along: a copy of what it is part of begins with an empty one, or keeps its own.
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
