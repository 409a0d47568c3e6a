#include "experiments/subjects/shape/edit.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/config/config.h"
#include "experiments/config/suggest.h"
#include "experiments/subjects/shape/edit_files.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

void check_action(const EditEntry& entry) {
  check_only_true(entry.fix, "fix", entry.where);
  const bool motion = entry.by || entry.rotate || entry.scale;
  const int given = entry.fix.has_value() + entry.to.has_value() + entry.matrix.has_value() +
                    entry.targets.has_value() + motion;
  if (given != 1) {
    throw InputError(fmt::format(
        "{}: needs exactly one of fix, to, matrix, targets, or any of scale, rotate and by; found "
        "{}",
        entry.where, given == 0 ? "none" : "several"));
  }
  if (entry.rotate && entry.rotate->axis.stableNorm() == 0) {
    throw InputError(fmt::format("{}: the rotation's axis must not be [0, 0, 0]", entry.where));
  }
  if (entry.scale && entry.scale->factor.value.minCoeff() <= 0) {
    throw InputError(fmt::format("{}: the factor of 'scale' is {}; it must be above 0", entry.where,
                                 text_of(entry.scale->factor.value, entry.dimension)));
  }
  if (entry.matrix && entry.matrix->value.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    throw InputError(fmt::format("{}: the last row of 'matrix' must be {}", entry.where,
                                 entry.dimension == 2 ? "[0, 0, 1]" : "[0, 0, 0, 1]"));
  }
  if (entry.fix && entry.weight != 1) {
    throw InputError(
        fmt::format("{}: what is fixed does not move at all and has no 'weight'", entry.where));
  }
}

// A file of targets selects by itself.
void check_selection(const EditEntry& entry) {
  if (entry.selection && entry.targets) {
    throw InputError(
        fmt::format("{}: 'targets' names its handles itself; leave 'select' out", entry.where));
  }
  if (entry.selection) {
    check_selection(*entry.selection, entry.where);
  } else if (!entry.targets) {
    throw InputError(
        fmt::format("{}: missing key 'select', which says what the entry is about", entry.where));
  }
}

/// The keys of an edit file.
struct EditFile {
  ConfigNode edit;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("edit", o.edit, "Selections and what happens to them");
  }
};

}  // namespace

void read_value(const ConfigNode& node, const std::string& name, ScaleFactor& value) {
  if (node.kind == ConfigNode::Kind::kList) {
    read_value(node, name, value.value);
    return;
  }
  double factor = 1;
  read_value(node, name, factor);
  value.value.setConstant(factor);
}

void read_value(const ConfigNode& node, const std::string& name, AffineMatrix& value) {
  std::vector<std::vector<double>> rows;
  read_value(node, name, rows);
  const auto is_short = [](const std::vector<double>& row) { return row.size() != 4; };
  if (rows.size() != 4 || std::ranges::any_of(rows, is_short)) {
    throw InputError(fmt::format("wrong value for {} ({}): expected a list of 4 rows of 4 numbers",
                                 quote(name), node.where()));
  }
  for (int i = 0; i < 4; ++i) value.value.row(i) = Eigen::Map<Eigen::RowVector4d>(rows[i].data());
}

ConfigNode to_node(const ScaleFactor& value) { return to_node(value.value); }

ConfigNode to_node(const AffineMatrix& value) {
  std::vector<std::vector<double>> rows;
  for (const auto& row : value.value.rowwise()) rows.emplace_back(row.begin(), row.end());
  return to_node(rows);
}

std::vector<EditEntry> read_edit(const ConfigNode& list, int dimension) {
  check_list(list, "edit");
  std::vector<EditEntry> entries;
  read_value(list, "edit", entries);
  if (entries.empty()) {
    throw InputError(fmt::format("'edit' has no entries ({})", list.where()));
  }
  for (std::size_t e = 0; e < entries.size(); ++e) {
    EditEntry& entry = entries[e];
    const ConfigNode& node = list.children[e];
    entry.where = fmt::format("edit entry {} ({})", e + 1, node.where());
    entry.dimension = dimension;
    check_action(entry);
    if (entry.selection) entry.selection->dimension = dimension;
    check_selection(entry);
    if (entry.targets) {
      const std::filesystem::path folder = node.find("targets")->folder();
      entry.listed = read_targets(folder / *entry.targets, dimension, entry.where);
    } else {
      read_selection_file(*entry.selection, *node.find("select"), entry.where);
    }
  }
  return entries;
}

void put_edit(const std::filesystem::path& path, ConfigNode& root) {
  root.children.push_back(read_config<EditFile>(load_config(path)).edit);
}

}  // namespace deformlab
