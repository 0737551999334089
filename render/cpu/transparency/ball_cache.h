// The balls of the cells that rays have last passed, as sets. Rays of neighboring pixels pass the same cells. Used by
// field_crossing.cpp; each thread has a cache.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/prepare/cells/tiles.h"
#include "render/prepare/rays/ball_set.h"
#include "render/prepare/rays/field_cells.h"

namespace render {

class BallCache {
 public:
    /// Forgets all sets but those of this field, and keeps their memory.
    void prepareFor(const FieldCells& field) {
        if (field.id == fieldId_) return;
        fieldId_ = field.id;
        for (Entry& entry : entries_) entry.key = kNone;
    }

    /// The balls that reach a subcell. @pre it has a list of them
    const BallSet& ofSubcell(const BallCells& cells, const FieldCells& field, std::size_t index) {
        Entry& entry = entryOf(static_cast<std::int64_t>(index));
        if (entry.isNew) {
            const Subcell& subcell = field.subcells[index];
            entry.balls.assign(cells, static_cast<std::size_t>(subcell.count),
                               [&](std::size_t k) { return field.balls[subcell.first + k]; });
        }
        return entry.balls;
    }

    /// The balls of a cell and of those around it.
    const BallSet& around(const BallCells& cells, glm::ivec3 cell) {
        const std::size_t index = cellIndex(cells.count, cell.x, cell.y, cell.z);
        Entry& entry = entryOf(-2 - static_cast<std::int64_t>(index));
        if (entry.isNew) entry.balls.assignAround(cells, cell);
        return entry.balls;
    }

 private:
    static constexpr std::int64_t kNone = -1;

    struct Entry {
        std::int64_t key = kNone;  // subcells count from 0, cells down from -2
        bool isNew = false;
        BallSet balls;
    };

    Entry& entryOf(std::int64_t key) {
        // Fibonacci hashing: numbers near each other get entries far apart.
        const std::uint64_t scattered = static_cast<std::uint64_t>(key) * 0x9e3779b97f4a7c15ULL;
        Entry& entry = entries_[scattered >> 55U];
        entry.isNew = entry.key != key;
        entry.key = key;
        return entry;
    }

    std::uint64_t fieldId_ = 0;
    std::array<Entry, 512> entries_;  // chosen: some hundred kilobytes
};

}  // namespace render
