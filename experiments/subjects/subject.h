#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/measure/drag.h"
#include "experiments/measure/measurements.h"
#include "experiments/subjects/claims.h"
#include "experiments/subjects/deformer_kind.h"
#include "experiments/subjects/outputs.h"
#include "render/image.h"
#include "solvers/summary.h"

namespace deformlab {

struct PictureOptions;
struct RunOptions;

/// What one run measured.
struct Run {
  MeasuredRun measured;
  Metrics seconds;
  Summary solve;  ///< the last solve
  std::vector<std::string> notes;
  Eigen::Matrix3Xd V{};      ///< deformed vertices of a shape or a drawing, 3×#V [length]
  double size = 1;           ///< diagonal of its bounding box at rest [length]
  bool many_solves = false;  ///< true for an animation: metrics are about the solves of all frames
};

/// The panels of all runs of one kind of subject.
class Book {
 public:
  virtual ~Book() = default;
  virtual bool empty() const = 0;
  virtual Image render() const = 0;
  /// The pictures of an image sequence, with panels of `width` [pixel]; empty if there is none.
  virtual std::vector<Image> sequence(int /*width*/) const { return {}; }
};

/// What the command line of `deform` or `animate` says about its run.
struct CommandLine {
  std::string input;                     ///< the file of the subject, or the pattern of its files
  std::string edit;                      ///< the YAML file of the edit
  std::string out, metrics, picture;     ///< files to write; the last two may be empty
  bool strict = false;                   ///< write nothing if the edit is not done
  int nodes = 0;                         ///< graph.nodes, unless a key=value sets it
  int vertices = 0;                      ///< drawing.vertices, unless a key=value sets it
  std::vector<std::string> overrides{};  ///< key=value
  std::vector<NamedFile> inputs{};       ///< all files that the run reads

  /// The files that the flags name, in the order in which they are written.
  std::vector<NamedFile> outputs() const {
    return {{out, "--out"}, {metrics, "--metrics"}, {picture, "--picture"}};
  }
};

/// Where a run takes place.
struct RunContext {
  std::filesystem::path folder;  ///< of the config, where relative paths begin
  /// The command line of a command, which writes the deformed subject to `out`. A config writes no
  /// subject.
  std::optional<CommandLine> command;

  bool writes() const { return command.has_value(); }
  /// Whether to measure. A command that writes no metrics saves this time.
  bool measures() const { return !command || !command->metrics.empty(); }
  /// The same for pictures.
  bool draws() const { return !command || !command->picture.empty(); }
};

/// Something that can be deformed: a shape, a drawing, a mesh animation, or particles. Its
/// constructor only stores its options and its context. Then each run calls, in this order, check,
/// read, deform and, if they are needed, measure, draw and write.
///
/// A subject that does not fit into memory, such as a long animation, is deformed, measured and
/// written frame by frame in `deform`; `write` then completes the file.
class Subject {
 public:
  virtual ~Subject() = default;

  /// Throws InputError for options and an edit that this kind of subject does not support. Reads
  /// nothing.
  virtual void check() const = 0;
  /// Reads the subject and finds what the edit selects. Throws InputError if the subject cannot be
  /// read, the edit does not fit it, or the command's files cannot be written.
  virtual void read() = 0;
  virtual void deform() = 0;
  /// The last solve of `deform`.
  virtual const Summary& solve() const = 0;
  /// What failed, in a sentence for the user; empty if all was solved.
  virtual std::string failure() const;
  /// What the edit asked for and the result does not show, or what is wrong with it, one sentence
  /// each (experiments/measure/shortfalls.h).
  virtual std::vector<std::string> shortfalls() const { return {}; }
  virtual Run measure() const = 0;
  /// Adds panels to a book that the make_book of this kind of subject has made.
  virtual void draw(Book& book, const std::string& caption) = 0;
  /// Writes the deformed subject to the command's `out`.
  virtual void write() = 0;
  /// What the command prints about the run when all is written.
  virtual std::string summary() const = 0;
};

/// A kind of subject, as configs and commands know it.
struct SubjectKind {
  const char* name;      ///< "a drawing"
  const char* flag;      ///< the flag that names its file; empty: the first argument does
  const char* file_key;  ///< the key of a config that names its file: "drawing.file"
  std::vector<std::string> meaningless;  ///< keys of a config that have no effect on it
  /// What `deformer: auto` means for it.
  DeformerKind automatic = DeformerKind::kEmbeddedDeformation;

  /// Whether the options of a config describe such a subject.
  bool (*is_in)(const RunOptions&);
  /// Whether a command line whose first argument is the subject describes this kind.
  bool (*reads)(const CommandLine&);
  /// Puts the edit of a command into the config of its run.
  void (*load_edit)(const std::filesystem::path& edit, ConfigNode& root);
  /// Puts those defaults into the config that this kind only has for commands.
  void (*set_defaults)(const CommandLine&, ConfigNode& root);
  std::unique_ptr<Subject> (*make)(const RunOptions&, const RunContext&);
  /// Kinds with the same function have their panels in one book.
  std::unique_ptr<Book> (*make_book)(const PictureOptions&);
};

/// All kinds of subjects. The first is a shape, which is every subject that is of no other kind.
const std::vector<SubjectKind>& subject_kinds();

/// The kind of subject that the options of a config describe.
const SubjectKind& kind_of(const RunOptions& options);

/// The kind of subject whose file is on a command line, after `flag` or, if that is empty, as the
/// first argument. Throws InputError for a flag that no kind has.
const SubjectKind& kind_of(const CommandLine& line, std::string_view flag);

/// Logs what a user should know about a report. A command also logs that a solve has not converged.
/// In a config, claims check this.
void log_notes(const Report& report, const RunContext& context);

/// The measurements of every subject whose handles are dragged. `size` is the diagonal of its
/// bounding box [length].
Run run_of(const DragReport& drag, const ResolvedEdit& edit, const Eigen::Matrix3Xd& V,
           double size);

}  // namespace deformlab
