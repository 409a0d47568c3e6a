// The target of libFuzzer. DEFORMLAB_READER in the environment names the reader; the processes that
// libFuzzer starts take it over. An exception that is no InputError ends the program, which
// libFuzzer records as a finding.
#include <glog/logging.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "geometry/core/error.h"
#include "tests/fuzz/readers.h"

namespace {

const deformlab::fuzz::Reader& chosen_reader() {
  FLAGS_minloglevel = google::GLOG_ERROR;  // warnings of each input would fill the disk
  static const std::vector<deformlab::fuzz::Reader> all = deformlab::fuzz::readers();
  const char* name = std::getenv("DEFORMLAB_READER");
  for (const auto& reader : all) {
    if (name != nullptr && reader.name == name) return reader;
  }
  std::fputs("DEFORMLAB_READER has to name a reader; known:", stderr);
  for (const auto& reader : all) std::fprintf(stderr, " %s", reader.name.c_str());
  std::fputc('\n', stderr);
  std::exit(2);
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): libFuzzer chose the name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const deformlab::fuzz::Reader& reader = chosen_reader();
  try {
    reader.read({reinterpret_cast<const char*>(data), size});
  } catch (const deformlab::InputError&) {  // the one way in which a reader may refuse
  }
  return 0;
}
// NOLINTEND(readability-identifier-naming)
