#include "experiments/subjects/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "experiments/config/config.h"
#include "experiments/config/suggest.h"
#include "experiments/measure/reference.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr std::size_t kLongestLabel = 40;  // longer values are cut in captions

ConfigNode with_overrides(ConfigNode root, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) apply_override(root, change);
  return root;
}

// Throws InputError for an override that the sweep would silently replace.
void check_not_swept(const std::vector<Override>& overrides, const ConfigNode& sweep) {
  for (const Override& change : overrides) {
    for (const ConfigNode* swept : swept_keys(sweep)) {
      const bool same = change.key == swept->key || change.key.starts_with(swept->key + ".") ||
                        swept->key.starts_with(change.key + ".");
      if (!same) continue;
      throw InputError(
          fmt::format("override {}: the config sweeps over '{}' itself ({}); override "
                      "'sweep={{...}}' instead, or 'sweep=null' for a single run",
                      quote(change.text()), swept->key, swept->key_where()));
    }
  }
}

ExperimentConfig read(const ConfigNode& root) {
  ExperimentConfig config;
  begin_with_preset(root, config.run.method);
  read_value(root, "", config);
  complete_energies(root, config.run.method.deformation);
  return config;
}

// Adds the seconds to the metrics, because claims may be about times too.
std::vector<MeasuredRun> with_seconds(const std::vector<Run>& runs) {
  std::vector<MeasuredRun> result;
  for (const Run& run : runs) {
    result.push_back(run.measured);
    result.back().metrics.insert(run.seconds.begin(), run.seconds.end());
  }
  return result;
}

// Throws InputError for a swept key that belongs to all runs: the claims, the sweep, and the
// picture except for the direction of view.
void check_swept_keys(const ConfigNode& sweep) {
  for (const ConfigNode* swept : swept_keys(sweep)) {
    if (swept->key == "picture.direction" || swept->key == "picture.up") continue;
    const std::string key = swept->key.substr(0, swept->key.find('.'));
    for (const char* whole : {"title", "paper", "picture", "sweep", "claims"}) {
      if (key != whole) continue;
      throw InputError(
          fmt::format("the sweep over {} ({}) changes no run: '{}' is one for all of them",
                      quote(swept->key), swept->key_where(), key));
    }
  }
}

// The pictures of all runs. Kinds of subjects that are pictured alike share a book.
class Library {
 public:
  explicit Library(const PictureOptions& options) {
    for (const SubjectKind& kind : subject_kinds()) {
      if (!find(kind)) books_.emplace_back(kind.make_book, kind.make_book(options));
    }
  }

  Book& of(const SubjectKind& kind) const { return *find(kind); }

  Image render() const {
    std::vector<Image> images;
    for (const auto& [make, book] : books_) {
      if (!book->empty()) images.push_back(book->render());
    }
    return images.size() == 1 ? images.front() : grid(images, 1);
  }

  std::vector<Image> sequence(int width) const {
    std::vector<Image> images;
    for (const auto& [make, book] : books_)
      std::ranges::move(book->sequence(width), std::back_inserter(images));
    return images;
  }

 private:
  Book* find(const SubjectKind& kind) const {
    const auto its = std::ranges::find(books_, kind.make_book, &Entry::first);
    return its == books_.end() ? nullptr : its->second.get();
  }

  using Entry = std::pair<std::unique_ptr<Book> (*)(const PictureOptions&), std::unique_ptr<Book>>;
  std::vector<Entry> books_;
};

Run run(const RunOptions& options, const std::filesystem::path& folder, const std::string& caption,
        const Library& library) {
  const SubjectKind& kind = kind_of(options);
  const std::unique_ptr<Subject> subject = kind.make(options, {folder, {}});
  subject->read();
  subject->deform();
  Run result = subject->measure();
  subject->draw(library.of(kind), caption);
  return result;
}

}  // namespace

std::string label(const MeasuredRun& run) {
  std::string text;
  for (const auto& [key, value] : run.settings) {
    const bool word = !value.empty() && std::isalpha(static_cast<unsigned char>(value.front())) &&
                      value != "true" && value != "false";
    const std::string name = word ? "" : key.substr(key.rfind('.') + 1) + " ";
    const bool fits = value.size() <= kLongestLabel;
    text += (text.empty() ? "" : ", ") + name + (fits ? value : value.substr(0, 12) + " …");
  }
  return text;
}

Plan plan_experiment(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  const ConfigNode root = with_overrides(load_config(path), overrides);
  Plan result{path.parent_path(), read(root), {}, {}, {}, {}};
  check(result.config.run.picture);
  for (const Claim& claim : result.config.claims) check_form(claim);
  check_not_swept(overrides, result.config.sweep);
  check_swept_keys(result.config.sweep);
  result.combinations = expand_sweep(result.config.sweep);
  for (const auto& combination : result.combinations) {
    const ConfigNode& its = result.roots.emplace_back(with_overrides(root, combination.overrides));
    const RunOptions& options = result.runs.emplace_back(read(its).run);
    check_run_options(options, its);
    with_lines_of(its, [&] { kind_of(options).make(options, {result.folder, {}})->check(); });
  }
  if (result.config.run.measure.reference.kind != ConfigNode::Kind::kNull) {
    result.reference = find_reference(result.config.run.measure.reference, result.combinations);
  }
  return result;
}

Outcome run_experiment(const Plan& planned, const Progress& progress) {
  Outcome outcome;
  outcome.config = planned.config;
  outcome.resolved = to_node(outcome.config);
  const Library library(outcome.config.run.picture);
  const std::size_t count = planned.runs.size();
  for (std::size_t i = 0; i < count; ++i) {
    MeasuredRun settings;
    settings.settings = planned.combinations[i].settings;
    progress(i + 1, count, label(settings));
    const std::string caption = count > 1 ? label(settings) : "deformed";
    outcome.runs.push_back(with_lines_of(
        planned.roots[i], [&] { return run(planned.runs[i], planned.folder, caption, library); }));
    outcome.runs.back().measured.settings = settings.settings;
  }
  if (planned.reference) {
    for (Run& run : outcome.runs) {
      run.measured.metrics.merge(difference(run, outcome.runs[*planned.reference]));
    }
  }
  const std::vector<MeasuredRun> measured = with_seconds(outcome.runs);
  for (const Claim& claim : outcome.config.claims) outcome.claims.push_back(check(claim, measured));
  outcome.picture = library.render();
  outcome.frames = library.sequence(outcome.config.run.animation.sequence.width);
  return outcome;
}

}  // namespace deformlab
