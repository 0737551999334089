# embed_texts(OUTPUT FOLDER HEADER FUNCTION NAME...): writes a C++ file that defines FUNCTION(std::string_view name), declared in
# HEADER, to return the text of FOLDER/NAME..., again whenever one of them changes.
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
