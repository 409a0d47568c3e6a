#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

#include "experiments/subjects/shape/edit.h"
#include "tests/support/errors.h"

namespace deformlab::test {

/// The edit of this list, whose file is "e.yaml" in the folder of temporary files.
inline std::vector<EditEntry> read_edit_text(const std::string& text) {
  return read_edit(parse_yaml(
      text, std::make_shared<const ConfigSource>(ConfigSource{"e.yaml", ::testing::TempDir()})));
}

/// The message of the InputError that reading and resolving gives, or "" where it gives none.
inline std::string edit_error_of(const std::string& text, const Shape& shape) {
  return error_of([&] { resolve(read_edit_text(text), shape); });
}

/// Writes a file to the folder of temporary files.
inline void put_temporary(const std::string& name, const std::string& text) {
  std::ofstream(std::filesystem::path(::testing::TempDir()) / name) << text;
}

}  // namespace deformlab::test
