#include "experiments/config/yaml_check.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

/// How many values there are, and how many bytes they have.
struct Size {
  std::size_t values = 0, bytes = 0;
  Size operator+(const Size& o) const { return {values + o.values, bytes + o.bytes}; }
  Size operator-(const Size& o) const { return {values - o.values, bytes - o.bytes}; }
};

/// Adds up what the document will hold, and refuses a second one. YAML::Load would ignore it, and
/// YAML::LoadAll never ends if stray text, such as a comma at the beginning, makes empty documents
/// without end.
class Meter : public YAML::EventHandler {
 public:
  explicit Meter(std::shared_ptr<const ConfigSource> source) { at_.source = std::move(source); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ < 2) return;
    at_.line = mark.line + 1;
    throw InputError(fmt::format(
        "a second YAML document, or a stray sign before it ({}); keep one document", at_.where()));
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { scalar(mark, "", anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    begin_value();
    add(anchors_[anchor], mark);  // nothing where it contains itself
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string& value) override {
    scalar(mark, value, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor, false);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor, true);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    YAML::anchor_t anchor;
    Size before;
    bool is_map, is_key;  // whether a key of the map comes next
  };

  // Returns whether the next value is the key of a map.
  bool begin_value() {
    if (levels_.empty() || !levels_.back().is_map) return false;
    const bool was_key = levels_.back().is_key;
    levels_.back().is_key = !was_key;
    return was_key;
  }

  void add(const Size& size, const YAML::Mark& mark) {
    total_ = total_ + size;
    if (total_.values <= kMaxConfigValues && total_.bytes <= kMaxConfigBytes) return;
    at_.line = mark.line + 1;
    throw InputError(fmt::format(
        "more than {} values or {} MiB of text ({}) with all aliases expanded; make the file "
        "smaller",
        kMaxConfigValues, kMaxConfigBytes >> 20, at_.where()));
  }

  void scalar(const YAML::Mark& mark, const std::string& value, YAML::anchor_t anchor) {
    const Size size{begin_value() ? 0u : 1u, value.size()};
    anchors_[anchor] = size;
    add(size, mark);
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor, bool is_map) {
    begin_value();
    levels_.push_back({anchor, total_, is_map, is_map});
    add({1, 0}, mark);
  }

  void close() {
    anchors_[levels_.back().anchor] = total_ - levels_.back().before;
    levels_.pop_back();
  }

  ConfigNode at_;  // for messages
  int documents_ = 0;
  Size total_;
  std::vector<Level> levels_;
  std::map<YAML::anchor_t, Size> anchors_;
};

// The bytes of the character that begins a text, or 0 if it is not UTF-8.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const unsigned char second =
      byte(1);  // excludes longer forms, surrogates, and what Unicode lacks
  const bool wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                     (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return wrong ? 0 : size;
}

}  // namespace

std::size_t find_invalid_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = character(text.substr(at));
    if (size == 0) return at;
    at += size;
  }
  return std::string_view::npos;
}

void check_yaml(const std::string& text, std::shared_ptr<const ConfigSource> source) {
  const std::size_t wrong = find_invalid_utf8(text);
  if (wrong != std::string_view::npos) {
    ConfigNode at;
    at.source = std::move(source);
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(wrong);
    at.line = static_cast<int>(std::count(text.begin(), end, '\n')) + 1;
    throw InputError(fmt::format("byte 0x{:02X} is not UTF-8 ({}); save the file as UTF-8",
                                 static_cast<unsigned char>(text[wrong]), at.where()));
  }
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Meter meter(std::move(source));
  while (parser.HandleNextDocument(meter)) {
  }
}

}  // namespace deformlab
