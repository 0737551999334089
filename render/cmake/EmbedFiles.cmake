# embed_files(OUTPUT NAME...): writes a C++ file that defines render::shaderSource(name) for shaders/NAME..., again whenever one
# of them changes.
function(embed_files output)
    set(paths "")
    foreach(name IN LISTS ARGN)
        list(APPEND paths ${CMAKE_CURRENT_SOURCE_DIR}/shaders/${name})
    endforeach()
    add_custom_command(OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} "-DPATHS=${paths}" -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/write_embedded.cmake
        DEPENDS ${paths} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/write_embedded.cmake
        VERBATIM)
endfunction()
