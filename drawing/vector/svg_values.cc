#include "drawing/vector/svg_values.h"

#include <charconv>

#include "geometry/core/text.h"

namespace deformlab {
namespace {

/// Collects the control points of one curve after the other.
class Pen {
 public:
  explicit Pen(const Eigen::Affine2d& map) : map_(map) {}

  void command(char letter, const std::vector<double>& values) {
    if (letter == 'M') end(false);
    if (letter == 'Z') return end(true);
    const Eigen::Matrix2Xd p =
        map_ * Eigen::Matrix2Xd::Map(values.data(), 2, std::ssize(values) / 2);
    if (letter == 'M' && p.cols() == 1) points_ = {p.col(0)};
    if (points_.empty()) return;
    if (letter == 'L' && p.cols() == 1) line_to(p.col(0));
    if (letter == 'C' && p.cols() == 3)
      for (int i = 0; i < 3; ++i) points_.push_back(p.col(i));
  }

  std::vector<Curve> finish() {
    end(false);
    return std::move(curves_);
  }

 private:
  void line_to(const Eigen::Vector2d& to) {
    const Eigen::Vector2d from = points_.back();
    points_.push_back(from + (to - from) / 3);
    points_.push_back(from + (to - from) * 2 / 3);
    points_.push_back(to);
  }

  void end(bool closed) {
    if (closed && points_.size() > 1 && points_.back() != points_.front())
      line_to(Eigen::Vector2d(points_.front()));
    if (points_.size() > 1) {
      Curve curve{Eigen::Matrix2Xd(2, std::ssize(points_)), closed};
      for (std::size_t i = 0; i < points_.size(); ++i)
        curve.points.col(static_cast<Eigen::Index>(i)) = points_[i];
      curves_.push_back(std::move(curve));
    }
    points_.clear();
  }

  Eigen::Affine2d map_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Curve> curves_;
};

}  // namespace

std::string_view local_name(std::string_view name) { return name.substr(name.find(':') + 1); }

std::vector<double> numbers(std::string_view text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* end = at + text.size();
  while (at != end) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error == std::errc()) values.push_back(value);
    at = error == std::errc() ? next : at + 1;
  }
  return values;
}

std::map<std::string_view, std::string_view> style_of(std::string_view text) {
  std::map<std::string_view, std::string_view> style;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(';'), text.size());
    const std::string_view pair = text.substr(0, end);
    const std::size_t colon = pair.find(':');
    if (colon != pair.npos) style[trimmed(pair.substr(0, colon))] = trimmed(pair.substr(colon + 1));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return style;
}

Eigen::Affine2d matrix_of(std::string_view text) {
  Eigen::Affine2d map = Eigen::Affine2d::Identity();
  const std::vector<double> v = numbers(text);
  if (v.size() == 6) map.matrix().topRows<2>() = Eigen::Matrix<double, 2, 3>::Map(v.data());
  return map;
}

std::vector<Curve> curves_of(std::string_view text, const Eigen::Affine2d& map) {
  Pen pen(map);
  constexpr std::string_view kCommands = "MLCZ";
  for (std::size_t at = text.find_first_of(kCommands); at != text.npos;) {
    const std::size_t next = text.find_first_of(kCommands, at + 1);
    pen.command(text[at], numbers(text.substr(at + 1, next - at - 1)));
    at = next;
  }
  return pen.finish();
}

}  // namespace deformlab
