// Squares first, then a counting sort by class.
#include "render/tile_table.h"

#include <algorithm>
#include <cstddef>

namespace render {

namespace {

struct Square {
    TileRow row;
    TileClass tileClass = TileClass::kept;
};

class Squares {
 public:
    Squares(std::span<const TileClass> classes, int columns) : classes_(classes), columns_(columns) {
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
        const TileClass first = classes_[at(left, top)];
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
        const TileClass its = classes_[at(column, row)];
        if (its != TileClass::kept) all_.push_back({{column, row, side}, its});
    }

    std::span<const TileClass> classes_;
    int columns_;
    std::vector<Square> all_;
};

}  // namespace

TileTable tileTable(std::span<const TileClass> classes, int columns) {
    const Squares squares(classes, columns);
    TileTable table;
    table.first.assign(kTileClasses + 1, 0);
    const auto indexOf = [](const Square& square) { return static_cast<std::size_t>(square.tileClass); };
    for (const Square& square : squares.all()) ++table.first[indexOf(square) + 1];
    for (std::size_t c = 0; c < kTileClasses; ++c) table.first[c + 1] += table.first[c];
    table.rows.resize(squares.all().size());
    std::vector<int> next = table.first;
    for (const Square& square : squares.all())
        table.rows[static_cast<std::size_t>(next[indexOf(square)]++)] = square.row;
    return table;
}

}  // namespace render
