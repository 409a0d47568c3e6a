#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace deformlab::fuzz {

using Texts = std::vector<std::string>;

/// One reader of what users give to the library or to the program.
struct Reader {
  std::string name;
  /// Reads the bytes. May throw InputError; whatever else it throws is a fault.
  std::function<void(const std::string& bytes)> read;
  /// Small inputs that are read without an error. The fuzzer begins with them.
  std::function<Texts()> samples;
  /// What such inputs are made of. The fuzzer puts these words into its inputs.
  std::function<Texts()> words;
};

/// All readers. A new reader gets an entry in the list of its kind.
std::vector<Reader> readers();

std::vector<Reader> shape_readers();
std::vector<Reader> drawing_readers();
std::vector<Reader> config_readers();
std::vector<Reader> list_readers();

/// A folder of this process. It goes when the process ends.
const std::filesystem::path& private_folder();

/// Writes the bytes into a file of the private folder.
std::filesystem::path put(const std::string& name, const std::string& bytes);

/// Throws std::logic_error, which no reader may throw, unless a statement about a reader holds.
void expect(bool holds, const char* statement);

}  // namespace deformlab::fuzz
