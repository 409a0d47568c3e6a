# deformlab_precompile(TARGET [GTest]): compiles the headers that most files include once, instead of
# in every file. All targets share one precompiled header, and all tests share another, which has
# GoogleTest too.
# A file must still include what it uses: the preset asan sets DEFORMLAB_PCH=OFF, so that
# continuous integration finds missing includes.
set(DEFORMLAB_COMMON_HEADERS
  <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <span> <sstream>
  <string> <string_view> <utility> <vector>
  <Eigen/Core> <Eigen/Geometry> <Eigen/SparseCore> <fmt/format.h>)

# deformlab_precompiled_headers(NAME LIBRARIES HEADERS): the target that compiles the headers.
function(deformlab_precompiled_headers name libraries headers)
  set(source ${PROJECT_BINARY_DIR}/${name}.cc)
  file(GENERATE OUTPUT ${source} CONTENT "// CMake wants a file in every target.\n")
  add_library(${name} OBJECT ${source})
  target_compile_definitions(${name} PRIVATE ${DEFORMLAB_EIGEN_DEFINITIONS})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen fmt::fmt ${libraries} deformlab_flags)
  target_precompile_headers(${name} PRIVATE ${headers})
  deformlab_precompile_flags(${name})
endfunction()

# GCC takes a precompiled header only if the flags are those that it was made with. CMake would give
# -fPIE to programs.
function(deformlab_precompile_flags target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL EXECUTABLE)
    target_compile_options(${target} PRIVATE -fPIC)
  else()
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)  # ccache needs it
endfunction()

function(deformlab_precompile target)
  if(NOT DEFORMLAB_PCH)
    return()
  endif()
  set(precompiled deformlab_precompiled${ARGN})
  if(NOT TARGET ${precompiled})
    if(ARGN)
      deformlab_precompiled_headers(${precompiled} "GTest::gmock;GTest::gtest"
        "${DEFORMLAB_COMMON_HEADERS};<gmock/gmock.h>;<gtest/gtest.h>")
    else()
      deformlab_precompiled_headers(${precompiled} "" "${DEFORMLAB_COMMON_HEADERS}")
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${precompiled})
  deformlab_precompile_flags(${target})
endfunction()
