#include "solvers/linear/blas.h"

#include <dlfcn.h>

#include <filesystem>

namespace deformlab {

namespace {

std::string find_name() {
  void* dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
  Dl_info info{};
  if (dgemm == nullptr || dladdr(dgemm, &info) == 0) return "unknown";
  std::error_code error;
  const auto file = std::filesystem::canonical(info.dli_fname, error);
  std::string name = (error ? std::filesystem::path(info.dli_fname) : file).filename().string();
  using Config = const char* (*)();
  const auto config = reinterpret_cast<Config>(dlsym(RTLD_DEFAULT, "openblas_get_config"));
  if (config != nullptr && name.find("openblas") != std::string::npos) {
    name += std::string(" (") + config() + ")";
  }
  return name;
}

}  // namespace

std::string blas_name() {
  static const std::string name = find_name();  // every solve asks for it
  return name;
}

}  // namespace deformlab
