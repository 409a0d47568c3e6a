#pragma once

#include <string>
#include <vector>

namespace deformlab {

/// A file that a command is going to write, and the flag that names it. The path may be empty.
struct Output {
  std::string path, flag;
};

/// Checks before the work whether files can be written after it. Throws InputError if a folder is
/// missing or no file can be made in it, and if a file is named twice, as two outputs or as an
/// output and one of `inputs`. Only the first input and the first output may be the same file.
void check_outputs(const std::vector<std::string>& inputs, const std::vector<Output>& outputs);

/// Throws InputError if the path is not empty and does not end in .png.
void check_picture_name(const std::string& path);

}  // namespace deformlab
