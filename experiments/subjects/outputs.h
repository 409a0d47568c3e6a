#pragma once

#include <string>
#include <vector>

namespace deformlab {

struct ConfigNode;

/// A file that a run reads or writes. Messages call it `name` and then its path: "--out 'a.off'".
/// The path may be empty; then there is no file.
struct NamedFile {
  std::string path, name;
};

/// The files that exist and that a config names as what its run reads: the values of the keys
/// `file`, `targets`, `mask`, `cursor` and `performance`.
std::vector<NamedFile> files_in(const ConfigNode& config);

/// Checks before the work whether files can be written after it. Throws InputError if a folder is
/// missing or no file can be made in it, and as check_distinct does.
void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws InputError if an output is one of `inputs`, or an earlier output, also where another
/// path or a link leads to it.
void check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws InputError if the path is not empty and does not end in .png.
void check_picture_name(const std::string& path);

}  // namespace deformlab
