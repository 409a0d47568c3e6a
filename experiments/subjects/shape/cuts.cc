#include "experiments/subjects/shape/cuts.h"

#include <fmt/format.h>

#include "experiments/config/config.h"
#include "experiments/subjects/shape/edit.h"

namespace deformlab {
namespace {

struct CutEntry {
  Selection between, other;
  std::string where;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("between", o.between, "Vertices, selected as in an edit");
    visit.required("and", o.other, "Vertices that must not follow the same nodes as the first");
  }
};

std::vector<CutEntry> read_cuts(const ConfigNode& list) {
  std::vector<CutEntry> entries;
  if (list.kind == ConfigNode::Kind::kNull) return entries;
  check_list(list, "cut");
  for (const ConfigNode& node : list.children) {
    CutEntry& entry = entries.emplace_back();
    entry.where = fmt::format("cut {} ({})", entries.size(), node.where());
    read_value(node, "cut", entry);
    check_selection(entry.between, entry.where);
    check_selection(entry.other, entry.where);
    read_selection_file(entry.between, *node.find("between"), entry.where);
    read_selection_file(entry.other, *node.find("and"), entry.where);
  }
  return entries;
}

}  // namespace

std::vector<Cut> resolve_cuts(const ConfigNode& list, const Shape& rest) {
  std::vector<Cut> cuts;
  for (const CutEntry& entry : read_cuts(list)) {
    cuts.push_back({select_vertices(entry.between, rest, entry.where),
                    select_vertices(entry.other, rest, entry.where), entry.where});
  }
  return cuts;
}

void check_cuts(const ConfigNode& list) { read_cuts(list); }

}  // namespace deformlab
