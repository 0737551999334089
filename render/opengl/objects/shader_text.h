// The text of shaders, complete with what they include.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace render {

/// The text of a file in shaders/, by its name; empty if there is no such file. Written by the build.
std::string_view shaderText(std::string_view name);

/// The text of a shader, and the names of the files that its lines come from.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  ///< the compiler's log names a file by its index in this list
};

/// Joins a shader and the files that its lines `#include "NAME"` name, behind the line `#version` and the definitions.
/// @param defines  preprocessor definitions, such as "SAMPLES 4"
/// @throws std::logic_error if there is no file of a name
ShaderSource shaderSource(std::string_view name, const std::vector<std::string>& defines);

/// A compiler's log with names of files in place of their indices, which it writes as 3:17 or 3(17).
std::string withFileNames(std::string_view log, const ShaderSource& source);

}  // namespace render
