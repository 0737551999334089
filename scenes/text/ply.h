// Reads the vertices of PLY files (the Stanford polygon format) as other programs write them: as text or binary of
// either byte order, with numbers of any type, beside properties, lists and elements that are not wanted. Called by
// model/particle_file.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

/// One number property of the vertices.
struct PlyColumn {
    std::string name;
    std::vector<double> values;  ///< one for each vertex
};

struct PlyVertices {
    std::size_t count = 0;
    std::vector<PlyColumn> columns;     ///< the wanted properties that the file has, in its order
    std::vector<std::string> comments;  ///< the comments of the header, without the word "comment"
    std::vector<std::string> skipped;   ///< what else it has, for messages: "red", "element face", "3 bytes at the end"

    /// The column of that name; nullptr if the file does not have it.
    const PlyColumn* column(std::string_view name) const;
};

/// Reads the wanted properties of the element "vertex". The memory taken is proportional to the number of bytes.
/// @param fileName  for messages
/// @throws InputError for what is no PLY file, for a vertex that is not all there, and for a wanted property that is
/// given twice or is a list
PlyVertices readPlyVertices(std::string_view bytes, const std::string& fileName,
                            std::span<const std::string_view> wanted);

}  // namespace scenes
