# Writes OUTPUT for embed_texts(), with HEADER and FUNCTION as there and PATHS, the list of files.
set(cases "")
foreach(path IN LISTS PATHS)
    get_filename_component(name ${path} NAME)
    file(READ ${path} text)
    string(APPEND cases "    if (name == \"${name}\") return R\"embedded(${text})embedded\";\n")
endforeach()
file(WRITE ${OUTPUT}
"// Written by the build.
#include \"${HEADER}\"

std::string_view ${FUNCTION}(std::string_view name) {
${cases}    return {};
}
")
