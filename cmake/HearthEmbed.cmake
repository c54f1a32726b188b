# hearth_embed_text(TARGET HEADER NAMESPACE FILES ...): embed text files of the current folder as constants of
# a library or program. HEADER declares them, "report.css" as `extern const std::string_view report_css;` in
# NAMESPACE.
function(hearth_embed_text target header namespace)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/embedded_text.cpp)
  set(paths "")
  foreach(file ${ARGN})
    list(APPEND paths ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${generated} -DHEADER=${header} -DNAMESPACE=${namespace} "-DFILES=${paths}"
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_text.cmake
    DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/embed_text.cmake
    COMMENT "Embedding ${header}"
    VERBATIM)
  target_sources(${target} PRIVATE ${generated})
endfunction()
