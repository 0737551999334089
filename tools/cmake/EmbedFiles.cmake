# embed_texts(OUTPUT FOLDER HEADER FUNCTION PATH...): the build writes the C++ file OUTPUT, again whenever one of the files
# FOLDER/PATH changes. It defines FUNCTION(std::string_view name), which HEADER declares and which returns the text of the file
# with that name, without folder, or an empty text.
set(EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/write_embedded.cmake)
function(embed_texts output folder header function)
    set(paths "")
    foreach(name IN LISTS ARGN)
        list(APPEND paths ${folder}/${name})
    endforeach()
    add_custom_command(OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${header} -DFUNCTION=${function} "-DPATHS=${paths}" -P ${EMBED_SCRIPT}
        DEPENDS ${paths} ${EMBED_SCRIPT}
        VERBATIM)
endfunction()
