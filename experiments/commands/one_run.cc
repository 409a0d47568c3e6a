#include "experiments/commands/one_run.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "experiments/commands/results.h"
#include "experiments/commands/standard_streams.h"
#include "experiments/config/config.h"
#include "experiments/config/override.h"
#include "experiments/config/suggest.h"
#include "experiments/subjects/methods.h"
#include "experiments/subjects/run_options.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

constexpr int kNotDone = 3;  // the exit status if the result is not what the edit asked for

// The keys that have an effect on such a subject. A message names no others.
std::vector<std::string> keys_of(const SubjectKind& kind) {
  FieldNames known;
  const RunOptions options;
  RunOptions::fields(options, known);
  std::erase_if(known.names, [&](const std::string& key) {
    return std::ranges::find(kind.meaningless, key) != kind.meaningless.end();
  });
  return known.names;
}

void check_overrides(const std::vector<Override>& overrides, const SubjectKind& kind) {
  const std::vector<std::string> known = keys_of(kind);
  for (const Override& change : overrides) {
    if (change.key == kind.file_key) {
      throw InputError(fmt::format("override {}: the command already names the file; leave it out",
                                   quote(change.text())));
    }
    const std::string key = change.key.substr(0, change.key.find('.'));
    if (std::ranges::find(known, key) != known.end()) continue;
    if (std::ranges::find(kind.meaningless, key) == kind.meaningless.end()) {
      throw InputError(fmt::format("override {}: unknown key {}; {}", quote(change.text()),
                                   quote(key), known_names(key, known)));
    }
    throw InputError(
        fmt::format("override {}: unknown key '{}' here, because '{}' means nothing for {} "
                    "that is read from a file; leave it out",
                    quote(change.text()), key, key, kind.name));
  }
}

std::vector<Override> read_overrides(const CommandLine& line, const SubjectKind& kind) {
  std::vector<Override> overrides;
  for (const std::string& text : line.overrides) overrides.push_back(parse_override(text));
  check_overrides(overrides, kind);
  return overrides;
}

// Options of another method do not stop a run, so that `deformer` can be changed alone.
void warn_of_other_methods(const std::vector<Override>& overrides, const SubjectKind& kind,
                           const RunOptions& options) {
  const DeformerKind named = options.method.deformer;
  const DeformerKind method = named == DeformerKind::kAuto ? kind.automatic : named;
  for (const Override& change : overrides) {
    const std::string key = change.key.substr(0, change.key.find('.'));
    if (!is_without_effect(key, method)) continue;
    LOG(WARNING) << fmt::format(
        "override {}: it has no effect on the deformer {}; it is for deformer={}",
        quote(change.text()), name_of(method), name_of(method_that_reads(key)));
  }
}

// The config of the run.
ConfigNode config_of(const SubjectKind& kind, const CommandLine& line,
                     const std::vector<Override>& overrides) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::kMap;
  kind.load_edit(line.edit, root);
  apply_override(root, {"graph.nodes", std::to_string(line.nodes), "."});
  kind.set_defaults(line, root);
  for (const Override& change : overrides) apply_override(root, change);
  apply_override(root, {kind.file_key, to_yaml_line(to_node(line.input)), "."});
  return root;
}

RunOptions read(const SubjectKind& kind, const ConfigNode& root) {
  RunOptions options = read_run_options(root);
  check_run_options(options, root);
  if (options.measure.reference.kind == ConfigNode::Kind::kNull) return options;
  throw InputError(
      fmt::format("measure.reference ({}) compares runs of a sweep, but this is one "
                  "run of {}; leave it out",
                  options.measure.reference.where(), kind.name));
}

Image picture_of(Subject& subject, const SubjectKind& kind, const PictureOptions& options,
                 const std::string& caption) {
  const std::unique_ptr<Book> book = kind.make_book(options);
  subject.draw(*book, caption);
  return book->render();
}

int run_and_write(const SubjectKind& kind, const CommandLine& line, const RunOptions& options,
                  const std::string& caption) {
  const std::unique_ptr<Subject> subject = kind.make(options, {"", line});
  subject->check();
  subject->read();
  subject->deform();
  if (const std::string failure = subject->failure(); !failure.empty()) {
    std::fprintf(stderr, "deformlab: %s\n", failure.c_str());
    return 1;
  }
  const std::vector<std::string> shortfalls = subject->shortfalls();
  for (const std::string& shortfall : shortfalls) {
    std::fprintf(stderr, "deformlab: not done: %s\n", shortfall.c_str());
  }
  if (line.strict && !shortfalls.empty()) {
    std::fputs("deformlab: nothing is written, because of --strict\n", stderr);
    return kNotDone;
  }
  // Measuring and drawing may fail, so they come before the first file is written.
  const bool measures = !line.metrics.empty(), draws = !line.picture.empty();
  const std::string metrics = measures ? to_json(subject->measure()) : "";
  const Image picture = draws ? picture_of(*subject, kind, options.picture, caption) : Image();
  subject->write();
  if (measures) write_file(line.metrics, metrics);
  if (draws) write_png(picture, line.picture);
  print_out(subject->summary());
  return shortfalls.empty() ? 0 : kNotDone;
}

}  // namespace

int run_once(const SubjectKind& kind, CommandLine line, const std::string& caption) {
  check_picture_name(line.picture);
  line.inputs = {{line.input, "the input"}, {line.edit, "the edit"}};
  check_outputs(line.inputs, line.outputs());
  const std::vector<Override> overrides = read_overrides(line, kind);
  const ConfigNode root = config_of(kind, line, overrides);
  std::ranges::move(files_in(root), std::back_inserter(line.inputs));
  check_distinct(line.inputs, line.outputs());
  const RunOptions options = read(kind, root);
  warn_of_other_methods(overrides, kind, options);
  return with_lines_of(root, [&] { return run_and_write(kind, line, options, caption); });
}

}  // namespace deformlab
