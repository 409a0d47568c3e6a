#pragma once

#include <string>

#include "experiments/subjects/subject.h"

namespace deformlab {

/// Does one run. The subject is the file of the command line, the edit has its own file, and
/// key=value sets all other options of a config. Writes the deformed subject, and the metrics and
/// the picture that the command line asks for. `caption` stands below the deformed subject in the
/// picture. Returns the exit status, which is 1 if the solver failed, and 3 if the result is not
/// what the edit asked for; with `strict` nothing is written then. Throws InputError for
/// anything that cannot be used, and for a file to write that the run also reads, before anything
/// is written.
int run_once(const SubjectKind& kind, CommandLine line, const std::string& caption);

}  // namespace deformlab
