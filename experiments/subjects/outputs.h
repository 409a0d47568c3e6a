#pragma once

#include <string>
#include <vector>

namespace deformlab {

/// A file that a command is going to write, and the flag that named it; the path may be empty.
struct Output {
  std::string path, flag;
};

/// Tries what is to be written before the work, not after it. Throws InputError where a folder is
/// missing or takes no new file, or a file is named twice: among the outputs, or as an output and
/// one of `inputs`; only the first input and the first output may be one file.
void check_outputs(const std::vector<std::string>& inputs, const std::vector<Output>& outputs);

/// Throws InputError where the path is neither empty nor ends in .png.
void check_picture_name(const std::string& path);

}  // namespace deformlab
