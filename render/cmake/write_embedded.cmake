# Run by embed_files: -DOUTPUT=file -DPATHS=list of shaders.
set(cases "")
foreach(path IN LISTS PATHS)
    get_filename_component(name ${path} NAME)
    file(READ ${path} text)
    string(APPEND cases "    if (name == \"${name}\") return R\"shader(${text})shader\";\n")
endforeach()
file(WRITE ${OUTPUT}
"// Written by the build from render/shaders.
#include \"render/program_cache.h\"

namespace render {

std::string_view shaderSource(std::string_view name) {
${cases}    return {};
}

}  // namespace render
")
