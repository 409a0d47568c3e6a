# deformlab_build_info(TARGET SOURCE...): lets TARGET include "deformlab_build_info.h", which says
# from which commit and how it was built. The header is written again only if git's HEAD or one of
# SOURCE changed, so that a build with nothing to do does nothing. The target deformlab_generated
# writes it too, for tools that read the code but do not compile it.
function(deformlab_build_info target)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/build_info/deformlab_build_info.h)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}" flags)
  if(DEFORMLAB_SANITIZE)
    string(APPEND flags " -fsanitize=${DEFORMLAB_SANITIZE}")
  endif()
  set(native false)
  if(DEFORMLAB_NATIVE)
    string(APPEND flags " -march=native")
    set(native true)
  endif()

  set(head)
  find_package(Git QUIET)
  if(GIT_FOUND)
    execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --path-format=absolute --git-path logs/HEAD
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE head
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT EXISTS "${head}")
      set(head)
    endif()
  endif()
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DOUTPUT=${header}
            -DVERSION=${PROJECT_VERSION} -DBUILD_TYPE=${CMAKE_BUILD_TYPE} -DCXX_FLAGS=${flags}
            -DNATIVE=${native} -P ${PROJECT_SOURCE_DIR}/cmake/WriteBuildInfo.cmake
    DEPENDS ${head} ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/WriteBuildInfo.cmake
            ${PROJECT_SOURCE_DIR}/cmake/deformlab_build_info.h.in
    COMMENT "Recording the commit" VERBATIM)
  add_custom_target(deformlab_generated DEPENDS ${header})
  add_dependencies(${target} deformlab_generated)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/build_info)
endfunction()
