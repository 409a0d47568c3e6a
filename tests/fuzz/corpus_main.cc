// corpus_main FOLDER: writes the samples of each reader to FOLDER/NAME/samples, and its words to
// FOLDER/NAME/words.dict, a dictionary of libFuzzer. Prints the names of all readers.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/readers.h"

namespace {

namespace fs = std::filesystem;
using deformlab::fuzz::Reader;

std::string quoted(const std::string& word) {
  std::string text;
  for (const char c : word) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return '"' + text + "\"\n";
}

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_corpus(const Reader& reader, const fs::path& folder) {
  fs::create_directories(folder / "samples");
  int number = 0;
  for (const std::string& sample : reader.samples()) {
    write(folder / "samples" / std::to_string(++number), sample);
  }
  std::string dictionary;
  for (const std::string& word : reader.words()) dictionary += quoted(word);
  write(folder / "words.dict", dictionary);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("corpus_main needs a folder\n", stderr);
    return 2;
  }
  for (const Reader& reader : deformlab::fuzz::readers()) {
    write_corpus(reader, fs::path(argv[1]) / reader.name);
    fmt::print("{}\n", reader.name);
  }
  return 0;
}
