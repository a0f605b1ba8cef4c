# The page's sources become strings of the program, so that a report can be written anywhere without installed files.
set(RELIEVO_PAGE_FOLDER ${PROJECT_SOURCE_DIR}/src/report/page)

function(relievo_report_page name)
  set(output ${PROJECT_BINARY_DIR}/generated/report/page_parts.cpp)
  file(GLOB parts CONFIGURE_DEPENDS ${RELIEVO_PAGE_FOLDER}/*)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D FOLDER=${RELIEVO_PAGE_FOLDER} -D OUTPUT=${output} -P ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake
    DEPENDS ${parts} ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake
    COMMENT "Embedding the report page" VERBATIM)
  target_sources(relievo_${name} PRIVATE ${output})
endfunction()
