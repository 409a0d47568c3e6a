# cmake --install gives a package that find_package(deformlab) finds.
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/deformlab)

install(EXPORT deformlabTargets NAMESPACE deformlab:: DESTINATION ${config_dir})
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/deformlabConfig.cmake.in ${PROJECT_BINARY_DIR}/deformlabConfig.cmake
  INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/deformlabConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/deformlabConfig.cmake
              ${PROJECT_BINARY_DIR}/deformlabConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindOpenBLASTarget.cmake
        DESTINATION ${config_dir})
