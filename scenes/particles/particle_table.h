// Particles as columns of numbers, which is what the readers of all formats make of a file. particle_file.cpp checks
// the numbers and makes particles of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

/// One number of each particle.
struct NumberColumn {
    std::string name;
    std::vector<double> values;
};

/// The rows of a file. Columns that mean something have these names, whatever the format calls them: x, y, z (m), vx,
/// vy, vz (m/s), radius, pscale or psize (m), mass (kg), birth_time (s), material and id (whole numbers).
struct ParticleTable {
    std::size_t count = 0;
    std::vector<NumberColumn> columns;
    std::vector<std::string> speciesNames;  ///< names of what the particles are made of, in order of appearance
    std::vector<std::uint32_t> species;     ///< for each particle an index into the names; empty if the file has none
    std::vector<std::string> comments;      ///< of a PLY header, without the word "comment"
    std::vector<std::string> skipped;       ///< what else the file has, for messages: "red", "element face"
    int firstLine = 0;  ///< line of the first row in a text file with a line for each row; 0 in other files

    /// The column of that name; nullptr if there is none.
    const NumberColumn* column(std::string_view name) const;
};

}  // namespace scenes
