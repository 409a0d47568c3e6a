#pragma once

#include <string>

#include "experiments/subjects/subject.h"

namespace deformlab {

/// Does one run, whose options are those of a config: the subject is the file of the command line,
/// the edit comes from a file of its own, and key=value sets all else. Writes the deformed subject,
/// and the metrics and the picture that the command line asks for; `caption` is of the deformed
/// subject in the picture. Returns the exit status: 1 where the solver failed. Throws InputError
/// for whatever cannot be used, before anything is written.
int run_once(const SubjectKind& kind, const CommandLine& line, const std::string& caption);

}  // namespace deformlab
