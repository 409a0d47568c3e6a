# The build runs this script. It writes deformlab_build_info.h, but only if its text changed.
# The commit is marked -dirty if code differs from it. Changed results or texts do not count.
set(COMMIT unknown)
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse HEAD WORKING_DIRECTORY ${SOURCE_DIR}
                  OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE
                  RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    execute_process(COMMAND ${GIT_EXECUTABLE} status --porcelain --
                            *.h *.cc *.cmake *CMakeLists.txt CMakePresets.json
                    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE changed)
    set(COMMIT ${head})
    if(changed)
      string(APPEND COMMIT -dirty)
    endif()
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/deformlab_build_info.h.in ${OUTPUT} @ONLY)
