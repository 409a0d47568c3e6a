#include "geometry/shape/formats/turning.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "geometry/shape/local_rotations.h"

namespace deformlab::formats {
namespace {

using Rotations = std::vector<Eigen::Matrix3d>;

/// A turned vector, or the old one where the two differ only by rounding, so that it keeps its
/// digits.
Eigen::VectorXd or_old(const Eigen::VectorXd& turned, const Eigen::VectorXd& old) {
  constexpr double kRounding = 1e-9;
  return (turned - old).norm() <= kRounding * old.norm() ? old : turned;
}

Eigen::Vector4d turned_quaternion(const Eigen::Matrix3d& R, const Eigen::Vector4d& wxyz) {
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(R) * Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  const Eigen::Vector4d result(q.w(), q.x(), q.y(), q.z());
  return result.dot(wxyz) < 0 ? Eigen::Vector4d(-result) : result;  // −q is the same rotation
}

void replace(std::vector<Edit>& edits, const Number* sources, const Eigen::VectorXd& old,
             const Eigen::VectorXd& values, Encoding encoding) {
  if (values == old) return;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    std::string text;
    append_number(text, values[k], sources[k].is_single, encoding);
    edits.push_back({sources[k].bytes, std::move(text)});
  }
}

void turn_attribute(std::vector<Edit>& edits, const Attribute& attribute, const Rotations& R,
                    Encoding encoding) {
  for (std::size_t i = 0; i < R.size(); ++i) {
    const std::size_t at = attribute.size * i;
    const Eigen::VectorXd old = Eigen::VectorXd::Map(&attribute.numbers.values[at],
                                                     static_cast<Eigen::Index>(attribute.size));
    if (!old.allFinite()) continue;
    const Eigen::VectorXd turned = attribute.size == 4
                                       ? Eigen::VectorXd(turned_quaternion(R[i], old))
                                       : Eigen::VectorXd(R[i] * old);
    replace(edits, &attribute.numbers.sources[at], old, or_old(turned, old), encoding);
  }
}

/// Normals of corners. The first corner that names a normal keeps its index. Where another corner
/// turns it otherwise, that corner gets a copy, which follows the last normal of the file.
class CornerNormals {
 public:
  CornerNormals(const Layout& layout, const Rotations& R) : layout_(layout), R_(R) {}

  std::vector<Edit> edits(std::string_view bytes) {
    for (const CornerNormal& corner : layout_.corners) {
      const Eigen::Vector3d normal = of(corner.normal);
      const bool turns = corner.vertex >= 0 && normal.allFinite();
      indices_.push_back(turns ? index_of(corner.normal, corner.vertex, normal) : corner.normal);
    }
    for (std::size_t c = 0; c < indices_.size(); ++c) name(layout_.corners[c], indices_[c]);
    if (!copies_.empty()) insert_copies(bytes);
    return std::move(edits_);
  }

 private:
  using Key = std::array<long, 4>;  // the normal and its turned coordinates, rounded

  Eigen::Vector3d of(int normal) const {
    return Eigen::Vector3d::Map(
        &layout_.shared_normals.values[3 * static_cast<std::size_t>(normal)]);
  }
  int count() const { return static_cast<int>(layout_.shared_normals.values.size() / 3); }

  int index_of(int normal, int vertex, const Eigen::Vector3d& old) {
    constexpr double kSteps = 1e6;  // coordinates that differ by less are the same
    const Eigen::Vector3d turned = or_old(R_[static_cast<std::size_t>(vertex)] * old, old);
    const Eigen::Vector3d unit = turned.stableNormalized() * kSteps;
    const Key key{normal, std::lround(unit.x()), std::lround(unit.y()), std::lround(unit.z())};
    const auto [found, is_new] = index_.try_emplace(key, normal);
    if (!is_new) return found->second;
    if (seen_.try_emplace(normal, true).second) {
      replace(edits_, &layout_.shared_normals.sources[3 * static_cast<std::size_t>(normal)], old,
              turned, Encoding::kText);
    } else {
      found->second = count() + static_cast<int>(copies_.size());
      copies_.push_back(turned);
    }
    return found->second;
  }

  /// Copies change what an index means that counts backwards, so that it counts from 1 instead.
  void name(const CornerNormal& corner, int index) {
    if (index == corner.normal && !(corner.relative && !copies_.empty())) return;
    edits_.push_back({{corner.at, corner.digits}, fmt::format("{}", index + 1)});
  }

  void insert_copies(std::string_view bytes) {
    const std::string_view before = bytes.substr(0, layout_.normals_end);
    const bool ended = before.ends_with('\n') || before.ends_with('\r');
    const std::string_view line_break = before.ends_with("\r\n") ? "\r\n"
                                        : before.ends_with('\r') ? "\r"
                                                                 : "\n";
    std::string text(ended ? "" : line_break);
    for (const Eigen::Vector3d& n : copies_) {
      append_column(text += "vn ", Eigen::Matrix3Xd(n), 0);
      text += line_break;
    }
    edits_.push_back({{layout_.normals_end, 0}, std::move(text)});
  }

  const Layout& layout_;
  const Rotations& R_;
  std::map<Key, int> index_;
  std::map<int, bool> seen_;
  std::vector<int> indices_;
  std::vector<Eigen::Vector3d> copies_;
  std::vector<Edit> edits_;
};

}  // namespace

std::vector<Edit> turn(std::string_view bytes, const ShapeFile& file, const Eigen::Matrix3Xd& V) {
  const Layout& layout = file.layout;
  const bool has_shared = !layout.shared_normals.values.empty();
  if (layout.attributes.empty() && !has_shared) return {};
  const Rotations R = local_rotations(file.shape, V);
  std::vector<Edit> edits;
  if (has_shared) edits = CornerNormals(layout, R).edits(bytes);
  for (const Attribute& one : layout.attributes) turn_attribute(edits, one, R, layout.encoding);
  return edits;
}

}  // namespace deformlab::formats
