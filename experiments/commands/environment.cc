#include "experiments/commands/environment.h"

#include <CGAL/version.h>
#include <ceres/version.h>
#include <cholmod.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <fstream>

#include "deformlab_build_info.h"
#include "solvers/linear/blas.h"

namespace deformlab {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string dotted(int a, int b, int c) { return fmt::format("{}.{}.{}", a, b, c); }

}  // namespace

std::map<std::string, std::string> environment() {
  return {
      {"deformlab", DEFORMLAB_VERSION},
      {"commit", DEFORMLAB_COMMIT},
      {"build_type", DEFORMLAB_BUILD_TYPE},
      {"cxx_flags", DEFORMLAB_CXX_FLAGS},
      {"native", DEFORMLAB_NATIVE ? "true" : "false"},
      {"compiler", "g++ " __VERSION__},
      {"processor", processor()},
      {"blas", blas_name()},
      {"threads", "1"},
      {"ceres", CERES_VERSION_STRING},
      {"cgal", CGAL_VERSION_STR},
      {"cholmod", dotted(CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)},
      {"eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
  };
}

}  // namespace deformlab
