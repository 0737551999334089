// Squares first, then a counting sort by class.
#include "render/tile_table.h"

#include <algorithm>
#include <cstddef>

#include "render/tile_class.h"

namespace render {

namespace {

struct Square {
    TileRow row;
    std::uint8_t tileClass = 0;
};

class Squares {
 public:
    Squares(std::span<const std::uint8_t> classes, int columns, std::span<const std::int32_t> lineSlots)
        : classes_(classes), lineSlots_(lineSlots), columns_(columns) {
        const int rows = static_cast<int>(classes.size()) / columns;
        for (int row = 0; row < rows; row += kSquareSide)
            for (int column = 0; column < columns; column += kSquareSide)
                addWithin(column, row, std::min(column + kSquareSide, columns), std::min(row + kSquareSide, rows));
    }

    const std::vector<Square>& all() const { return all_; }

 private:
    std::size_t at(int column, int row) const { return static_cast<std::size_t>(row * columns_ + column); }

    bool isWhole(int left, int top, int right, int bottom) const {
        if (right - left != kSquareSide || bottom - top != kSquareSide) return false;
        const std::uint8_t first = classes_[at(left, top)];
        if ((first & kLineBit) != 0) return false;
        for (int row = top; row < bottom; ++row)
            for (int column = left; column < right; ++column)
                if (classes_[at(column, row)] != first) return false;
        return true;
    }

    void addWithin(int left, int top, int right, int bottom) {
        if (isWhole(left, top, right, bottom)) {
            add(left, top, kSquareSide);
            return;
        }
        for (int row = top; row < bottom; ++row)
            for (int column = left; column < right; ++column) add(column, row, 1);
    }

    void add(int column, int row, int side) {
        const std::size_t tile = at(column, row);
        if (classes_[tile] != 0) all_.push_back({{column, row, side, lineSlots_[tile]}, classes_[tile]});
    }

    std::span<const std::uint8_t> classes_;
    std::span<const std::int32_t> lineSlots_;
    int columns_;
    std::vector<Square> all_;
};

}  // namespace

TileTable tileTable(std::span<const std::uint8_t> classes, int columns, std::span<const std::int32_t> lineSlots) {
    const Squares squares(classes, columns, lineSlots);
    TileTable table;
    table.first.assign(kClassCount + 1, 0);
    for (const Square& square : squares.all()) ++table.first[square.tileClass + std::size_t{1}];
    for (std::size_t c = 0; c < kClassCount; ++c) table.first[c + 1] += table.first[c];
    table.rows.resize(squares.all().size());
    std::vector<int> next = table.first;
    for (const Square& square : squares.all())
        table.rows[static_cast<std::size_t>(next[square.tileClass]++)] = square.row;
    return table;
}

}  // namespace render
