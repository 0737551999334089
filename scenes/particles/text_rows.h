// Text files that have a line for each particle, with a word for each column. Used by the readers of extended XYZ and
// of LAMMPS dumps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/particles/particle_table.h"

namespace scenes {

/// The lines of a text file, one after the other. A copy goes on from where the original was.
class TextLines {
 public:
    /// @param bytes, fileName  must outlive the object
    TextLines(std::string_view bytes, const std::string& fileName) : bytes_(bytes), fileName_(&fileName) {}

    /// The next line, without its end.
    /// @param expected  completes the error "the file ends before ..."
    /// @throws InputError at the end of the file
    std::string_view next(std::string_view expected);

    /// Whether nothing but blanks follows.
    bool isAtEnd() const;

    int lineNumber() const { return line_; }

    /// Throws an InputError that names the file and the line that was read last.
    [[noreturn]] void fail(const std::string& message) const;

 private:
    std::string_view bytes_;
    const std::string* fileName_;
    std::size_t at_ = 0;
    int line_ = 0;
};

/// Removes the first word from a text and returns it; empty if there is none.
std::string_view takeWord(std::string_view& text);

/// The words of a text.
std::vector<std::string_view> splitWords(std::string_view text);

/// A whole number that is alone on a line.
/// @throws InputError
std::uint64_t wholeNumber(const TextLines& lines, std::string_view text, std::string_view name);

/// A number.
/// @throws InputError
double realNumber(const TextLines& lines, std::string_view word, std::string_view name);

/// A column of a text file, and where its words go; nowhere if it is skipped.
struct TextColumn {
    std::string name;                       ///< for messages
    std::vector<double>* values = nullptr;  ///< where its numbers go
    bool isSpecies = false;                 ///< whether its words are the names of what particles are made of
};

/// Skips the rows of a table.
/// @throws InputError if the file ends before
void skipLines(TextLines& lines, std::uint64_t count);

/// Reads the rows of a table: appends to the values of the columns, and sets the species, the count and the first line
/// of the table. The memory taken is proportional to the number of bytes.
/// @throws InputError that names the line
void readTextRows(TextLines& lines, std::uint64_t count, std::span<const TextColumn> columns, ParticleTable& table);

/// Appends the shortest text that is read back as the same number.
void putNumber(std::string& text, double number);
void putNumber(std::string& text, std::uint32_t number);

/// A name as one word: blanks, control characters and quotation marks become underscores.
std::string asWord(const std::string& name);

}  // namespace scenes
