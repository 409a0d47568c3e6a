# Writes the globalization and the linear solver that CONTRIBUTING.md shows to OUTPUT_DIR, under the
# names that the page gives them, and the lines that register them to register_solvers.inc, so that
# the tests build the very text.
function(deformlab_extract_solvers output_dir)
  set(page ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
  file(READ ${page} text)
  foreach(folder gauss_newton/globalization linear)
    if(NOT text MATCHES "here `(solvers/${folder}/[a-z0-9_]+\\.h)`[^`]*```cpp\n([^`]*)```")
      message(FATAL_ERROR "CONTRIBUTING.md shows no file of solvers/${folder}")
    endif()
    file(CONFIGURE OUTPUT ${output_dir}/${CMAKE_MATCH_1} CONTENT "${CMAKE_MATCH_2}" @ONLY)
  endforeach()
  if(NOT text MATCHES "```cpp\n(register_[^`]*)```")
    message(FATAL_ERROR "CONTRIBUTING.md does not show how to register a solver")
  endif()
  file(CONFIGURE OUTPUT ${output_dir}/register_solvers.inc CONTENT "${CMAKE_MATCH_1}" @ONLY)
endfunction()
