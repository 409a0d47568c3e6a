# Finds OpenBLAS and gives it an imported target, OpenBLAS::OpenBLAS.
#
# Debian's libceres pulls in ATLAS, whose BLAS symbols then serve CHOLMOD too, twice as slowly.
# The dynamic linker takes the first definition it meets, so OpenBLAS has to come before Ceres
# on every link line and must not be dropped as unneeded: both are part of the target.
find_library(OpenBLAS_LIBRARY NAMES openblas
             PATH_SUFFIXES openblas-serial openblas-pthread openblas-openmp)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenBLASTarget REQUIRED_VARS OpenBLAS_LIBRARY)
if(OpenBLASTarget_FOUND AND NOT TARGET OpenBLAS::OpenBLAS)
  add_library(OpenBLAS::OpenBLAS INTERFACE IMPORTED)
  target_link_libraries(OpenBLAS::OpenBLAS INTERFACE
    -Wl,--push-state,--no-as-needed ${OpenBLAS_LIBRARY} -Wl,--pop-state)
endif()
