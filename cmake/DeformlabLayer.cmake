# deformlab_layer(NAME [INTERNAL] PUBLIC ... PRIVATE ...): the static library of one folder.
# An INTERNAL layer is not installed.
# Every .cc in it and in its folders is compiled, so a new file needs no line here.
include(DeformlabPrecompile)

add_library(deformlab_flags INTERFACE)
target_compile_features(deformlab_flags INTERFACE cxx_std_20)
target_compile_options(deformlab_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  # All targets must have the same macros if they share a precompiled header.
  $<$<BOOL:${DEFORMLAB_PCH}>:-pthread>
  $<$<BOOL:${DEFORMLAB_NATIVE}>:-march=native>)
# GCC 12 gives false alarms of these kinds about inlined members of Eigen and std::string. Clang and
# the sanitizers look for such faults instead.
foreach(alarm array-bounds maybe-uninitialized restrict stringop-overflow stringop-overread
        uninitialized use-after-free)
  target_compile_options(deformlab_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-${alarm}>)
endforeach()
if(DEFORMLAB_SANITIZE)
  add_compile_options(-fsanitize=${DEFORMLAB_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_compile_options(-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tests/sanitizers/ignored.txt)
  endif()
  add_link_options(-fsanitize=${DEFORMLAB_SANITIZE})
endif()
# Arrays of Eigen pass between our code, the packaged Ceres, and the code of our users, and each
# frees what another has allocated. All must therefore allocate in the same way, although sanitizers
# and wider registers would change it.
set(DEFORMLAB_EIGEN_DEFINITIONS)
if(DEFORMLAB_SANITIZE)
  list(APPEND DEFORMLAB_EIGEN_DEFINITIONS EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(DEFORMLAB_NATIVE)
  list(APPEND DEFORMLAB_EIGEN_DEFINITIONS EIGEN_MAX_ALIGN_BYTES=16)
endif()

function(deformlab_layer name)
  cmake_parse_arguments(ARG "INTERNAL" "" "PUBLIC;PRIVATE" ${ARGN})
  set(root ${PROJECT_SOURCE_DIR}/${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${root}/*.cc)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*.h)
  list(TRANSFORM headers PREPEND ${name}/)
  add_library(deformlab_${name} STATIC ${sources})
  add_library(deformlab::${name} ALIAS deformlab_${name})
  set_target_properties(deformlab_${name} PROPERTIES EXPORT_NAME ${name}
                        POSITION_INDEPENDENT_CODE ON)
  target_include_directories(deformlab_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/deformlab>)
  target_compile_features(deformlab_${name} PUBLIC cxx_std_20)
  target_compile_definitions(deformlab_${name} PUBLIC ${DEFORMLAB_EIGEN_DEFINITIONS})
  target_link_libraries(deformlab_${name} PUBLIC ${ARG_PUBLIC}
                        PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:deformlab_flags>)
  deformlab_precompile(deformlab_${name})
  if(ARG_INTERNAL)
    return()
  endif()
  install(TARGETS deformlab_${name} EXPORT deformlabTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  foreach(header ${headers})
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${header}
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/deformlab/${folder})
  endforeach()
endfunction()
