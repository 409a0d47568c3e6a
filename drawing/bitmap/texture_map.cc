#include "drawing/bitmap/texture_map.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "drawing/bitmap/uncovered_squares.h"
#include "geometry/core/error.h"
#include "geometry/core/workers.h"

namespace deformlab {
namespace {

constexpr int kBand = 32;                // rows drawn at once
constexpr int kMostSamples = 8;          // of the texture along each side of what is drawn
constexpr int kMostParts = 64;           // along each side of a pixel, if the whole drawing shrinks
constexpr double kCrisp = 1.5;           // pixels this near to the mesh follow one limb [texel]
constexpr double kThin = 2, kTorn = 10;  // growth of squares from which on they fade, and vanish
constexpr double kSameLayer = 2;         // two hits with a smaller distance are one layer [texel]
constexpr double kOpaqueEnough = 1e-4;   // with less transparency, farther layers are not visible

/// A triangle to be drawn.
struct Piece {
  Eigen::Matrix<double, 2, 3> at;    ///< corners in the output
  Eigen::Matrix<double, 2, 3> from;  ///< corners in the texture
  Eigen::Vector3d ink;               ///< share of the opacity that is kept at the corners
  double depth;
  bool is_square;  ///< whether it is half of a square outside the mesh
};

/// A piece that covers a pixel.
struct Hit {
  int pixel;
  std::size_t piece;
  Eigen::Vector2d source;  ///< the texture's coordinates at the pixel's centre
  double ink;
};

/// The derivative of the texture's coordinates with respect to those of the output.
Eigen::Matrix2d change(const Piece& piece) {
  const Eigen::Vector3d at_zero = barycentric(piece.at, {0, 0});
  Eigen::Matrix2d J;
  J << piece.from * (barycentric(piece.at, {1, 0}) - at_zero),
      piece.from * (barycentric(piece.at, {0, 1}) - at_zero);
  return J;
}

double greatest_stretch(const Eigen::Matrix2d& J) {
  const Eigen::Matrix2d S = J.transpose() * J;
  const double half = S.trace() / 2, off = (S(0, 0) - S(1, 1)) / 2;
  return std::sqrt(half + std::hypot(off, S(0, 1)));
}

/// Premultiplied colour and alpha, 0 … 1. Everything outside the bitmap is transparent.
Eigen::Vector4d texel(const Bitmap& texture, int x, int y) {
  if (x < 0 || y < 0 || x >= texture.width || y >= texture.height) return Eigen::Vector4d::Zero();
  const std::uint8_t* p = texture.pixel(x, y);
  const double a = p[3] / 255.0;
  return {a * p[0] / 255.0, a * p[1] / 255.0, a * p[2] / 255.0, a};
}

Eigen::Vector4d bilinear(const Bitmap& texture, const Eigen::Vector2d& point) {
  const Eigen::Vector2d limit(texture.width + 1, texture.height + 1);
  const Eigen::Vector2d p =
      (point.array() - 0.5).matrix().cwiseMax(Eigen::Vector2d(-2, -2)).cwiseMin(limit);
  const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
  const double u = p.x() - x, v = p.y() - y;
  return (1 - v) * ((1 - u) * texel(texture, x, y) + u * texel(texture, x + 1, y)) +
         v * ((1 - u) * texel(texture, x, y + 1) + u * texel(texture, x + 1, y + 1));
}

/// The mean of the texture over the part of it that the pixel covers.
Eigen::Vector4d sample(const Bitmap& texture, const Piece& piece, const Eigen::Vector2d& center) {
  const Eigen::Matrix2d J = change(piece);
  const double stretch = std::min<double>(kMostSamples, greatest_stretch(J));
  const int n = std::max(1, static_cast<int>(std::ceil(stretch - 0.05)));
  if (n == 1) return bilinear(texture, center);
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int i = 0; i < n * n; ++i) {
    const int column = i % n, row = i / n;
    const Eigen::Vector2d offset((column + 0.5) / n - 0.5, (row + 0.5) / n - 0.5);
    sum += bilinear(texture, center + J * offset);
  }
  return sum / (n * n);
}

/// Blends the hits of one pixel from the front to the back.
Eigen::Vector4d blend(const Bitmap& texture, const std::vector<Piece>& pieces, const Hit* begin,
                      const Hit* end) {
  Eigen::Vector4d color = Eigen::Vector4d::Zero();
  for (const Hit* hit = begin; hit != end && color[3] < 1 - kOpaqueEnough; ++hit) {
    const bool drawn = std::any_of(begin, hit, [&](const Hit& other) {
      return (other.source - hit->source).squaredNorm() < kSameLayer * kSameLayer;
    });
    if (drawn) continue;
    color += (1 - color[3]) * hit->ink * sample(texture, pieces[hit->piece], hit->source);
  }
  return color;
}

void store(const Eigen::Vector4d& premultiplied, std::uint8_t* pixel) {
  const double a = premultiplied[3];
  pixel[3] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(a, 0.0, 1.0)));
  if (pixel[3] == 0) return;
  for (int c = 0; c < 3; ++c)
    pixel[c] =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(premultiplied[c] / a, 0.0, 1.0)));
}

/// Draws the rows of `box`, a band of a picture in which each pixel of the output is parts × parts
/// pixels. A pixel of the output gets their mean.
void draw_band(const Bitmap& texture, const std::vector<Piece>& pieces,
               const std::vector<std::size_t>& here, const PixelBox& box, int parts, Bitmap& out) {
  std::vector<Hit> hits;
  for (const std::size_t i : here)
    for_each_pixel(pieces[i].at, box, [&](int x, int y, const Eigen::Vector3d& b) {
      hits.push_back({(y - box.top) * box.width + x, i, pieces[i].from * b, pieces[i].ink.dot(b)});
    });
  std::ranges::sort(hits, [&](const Hit& a, const Hit& b) {
    const Piece &p = pieces[a.piece], &q = pieces[b.piece];
    return std::tuple(a.pixel, -p.depth, p.is_square, b.piece) <
           std::tuple(b.pixel, -q.depth, q.is_square, a.piece);
  });
  const int rows = box.height / parts;
  Eigen::Matrix4Xd sums = Eigen::Matrix4Xd::Zero(4, Eigen::Index{rows} * out.width);
  for (auto begin = hits.begin(); begin != hits.end();) {
    const auto end =
        std::find_if(begin, hits.end(), [&](const Hit& hit) { return hit.pixel != begin->pixel; });
    const int x = begin->pixel % box.width / parts, y = begin->pixel / box.width / parts;
    sums.col(Eigen::Index{y} * out.width + x) +=
        blend(texture, pieces, &*begin, &*begin + (end - begin));
    begin = end;
  }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < out.width; ++x)
      store(sums.col(Eigen::Index{y} * out.width + x) / (parts * parts),
            out.pixel(x, box.top / parts + y));
}

double area_of(const Eigen::Matrix<double, 2, 3>& triangle) {
  return std::abs((triangle.rightCols<2>().colwise() - triangle.col(0)).determinant()) / 2;
}

double area_of(const Triangulation& mesh, const Eigen::Matrix2Xd& V) {
  double area = 0;
  for (Eigen::Index f = 0; f < mesh.F.cols(); ++f) area += area_of(corners(V, mesh.F, f));
  return area;
}

/// Into how many parts each side of a pixel is divided, so that a part is not much larger than a
/// pixel of the texture. What is drawn at the parts' centres would otherwise show only some of the
/// squares at the rim, and the rim would be jagged.
int parts_along(const Triangulation& mesh, const Eigen::Matrix2Xd& V) {
  constexpr double kNearlyOne = 1.05;  // a drawing that shrinks by less is drawn as it is
  const double shrinks = std::sqrt(area_of(mesh, mesh.V) / std::max(area_of(mesh, V), 1e-12));
  return shrinks < kNearlyOne ? 1
                              : static_cast<int>(std::min<double>(kMostParts, std::ceil(shrinks)));
}

/// What the corners of the squares keep of their opacity with the corners at V (2×n). Between two
/// limbs that part, squares become long. Their ink is spread over their area, so that a shadow
/// between the limbs fades instead of tearing, and at last nothing is left of it.
Eigen::VectorXd kept_ink(const Triangulation& squares, const Eigen::Matrix2Xd& V) {
  Eigen::VectorXd before = Eigen::VectorXd::Zero(V.cols()), after = before;
  for (Eigen::Index f = 0; f < squares.F.cols(); ++f)
    for (const int corner : squares.F.col(f)) {
      before[corner] += area_of(corners(squares.V, squares.F, f));
      after[corner] += area_of(corners(V, squares.F, f));
    }
  const Eigen::ArrayXd spread = kThin * before.array() / after.array().max(kThin * before.array());
  return ((spread - kThin / kTorn) / (1 - kThin / kTorn)).max(0.0).matrix();
}

/// For each band of rows, the pieces that overlap it.
std::vector<std::vector<std::size_t>> by_band(const std::vector<Piece>& pieces, int height,
                                              int band) {
  std::vector<std::vector<std::size_t>> bands(static_cast<std::size_t>((height + band - 1) / band));
  const double last = static_cast<double>(bands.size()) - 1;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double from = std::max(0.0, std::floor(pieces[i].at.row(1).minCoeff() / band));
    const double to = std::min(last, std::floor(pieces[i].at.row(1).maxCoeff() / band));
    for (double b = from; b <= to; ++b) bands[static_cast<std::size_t>(b)].push_back(i);
  }
  return bands;
}

}  // namespace

TextureMap::TextureMap(Bitmap texture, Triangulation rest)
    : texture_(std::move(texture)), rest_(std::move(rest)) {
  squares_ = uncovered_squares(rest_, texture_);
  square_corners_ = Binding(rest_, Locator(rest_), squares_.V, kCrisp);
}

Bitmap TextureMap::draw(const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth,
                        const TextureView& view) const {
  if (V.cols() != rest_.V.cols() || !V.allFinite())
    throw InputError("cannot draw: the deformed vertices must be as many as at rest, and finite");
  Bitmap out(view.width, view.height);
  const int parts = parts_along(rest_, view.scale * V);
  const auto in_parts = [&](const Eigen::Matrix<double, 2, 3>& at) {
    return Eigen::Matrix<double, 2, 3>(parts * view.scale * (at.colwise() - view.origin));
  };
  const Eigen::Matrix2Xd square_corners = square_corners_(V);
  const Eigen::VectorXd ink = kept_ink(squares_, square_corners);
  std::vector<Piece> pieces;
  const auto depth_of = [&](Eigen::Index f) { return depth.size() > 0 ? depth[f] : 0.0; };
  for (Eigen::Index f = 0; f < rest_.F.cols(); ++f)
    pieces.push_back({in_parts(corners(V, rest_.F, f)), corners(rest_.V, rest_.F, f),
                      Eigen::Vector3d::Ones(), depth_of(f), false});
  for (Eigen::Index f = 0; f < squares_.F.cols(); ++f)
    pieces.push_back({in_parts(corners(square_corners, squares_.F, f)),
                      corners(squares_.V, squares_.F, f), ink(squares_.F.col(f)),
                      depth_of(square_corners_.triangle(squares_.F(0, f))), true});
  const int band_rows = std::max(1, kBand / parts) * parts, rows = view.height * parts;
  const auto bands = by_band(pieces, rows, band_rows);
  Workers(0).each(static_cast<int>(bands.size()), [&](int band) {
    const int top = band * band_rows, height = std::min(band_rows, rows - top);
    draw_band(texture_, pieces, bands[static_cast<std::size_t>(band)],
              {0, top, view.width * parts, height}, parts, out);
  });
  return out;
}

}  // namespace deformlab
