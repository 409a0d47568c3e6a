#include "render/render.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/core/error.h"
#include "geometry/core/workers.h"
#include "render/openness.h"
#include "render/ray_scene.h"
#include "render/surface.h"

namespace deformlab {
namespace {

constexpr float kHiddenOpacity = 0.55F;  // of balls and sticks just below the surface
constexpr float kFadeDepth = 0.06F;      // where they become invisible [framed coordinates]
constexpr double kAlike = 10;            // shapes with a greater ratio of sizes are framed singly
constexpr float kForgivenDepth = 2.0F;   // what is less deep counts as on the surface [radii]
constexpr int kContrast = 6;             // between neighbouring pixels that need more rays [of 255]

/// Directions towards the lights in the axes of the camera, so that every view is lit.
struct Lights {
  Eigen::Vector3f key, fill, sky;

  Lights(const View& view, const Eigen::Vector3d& toward_key)
      : key(view_direction(view, toward_key)),
        fill(view_direction(view, {0.80, 0.10, 0.60})),
        sky(view_direction(view, {0.00, 1.00, 0.15})) {}

  static Eigen::Vector3f view_direction(const View& view, const Eigen::Vector3d& d) {
    return (d.x() * view.right + d.y() * view.up - d.z() * view.forward).normalized().cast<float>();
  }

  /// A large light also reaches a little beyond the edge where the cosine is zero.
  static float soft(float cosine) {
    constexpr float kWrap = 0.15F;
    return std::max(0.0F, (cosine + kWrap) / (1 + kWrap));
  }

  Eigen::Vector3f shade(const Eigen::Vector3f& albedo, const Eigen::Vector3f& n, float open) const {
    const float direct =
        0.85F * soft(n.dot(key)) * (0.4F + 0.6F * open) + 0.18F * soft(n.dot(fill)) * open;
    const float ambient = (0.26F + 0.10F * n.dot(sky)) * (0.15F + 0.85F * open);
    return (direct + ambient) * albedo;
  }
};

/// Balls and sticks, in framed coordinates.
struct Overlay {
  RayScene scene;
  Eigen::RowVectorXf radius[2];
  Eigen::Matrix3Xf color[2];
};

void require_finite(const Eigen::Vector3d& place, double radius, const Color& color,
                    const std::string& what) {
  if (place.allFinite() && std::isfinite(radius) && radius >= 0 && color.allFinite()) return;
  throw InputError(fmt::format(
      "cannot draw {}: its position, radius and colour must be finite, and its radius not negative",
      what));
}

Eigen::Vector4f framed_ball(const View& view, const Eigen::Vector3d& center, double radius) {
  Eigen::Vector4d ball;
  ball << (center - view.center) / view.size, radius / view.size;
  return ball.cast<float>();
}

void lay_balls(const std::vector<Ball>& balls, const View& view, Overlay& overlay) {
  const auto count = static_cast<Eigen::Index>(balls.size());
  Eigen::Matrix4Xf columns(4, count);
  overlay.color[0].resize(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Ball& ball = balls[static_cast<std::size_t>(i)];
    require_finite(ball.center, ball.radius, ball.color, fmt::format("ball {}", i));
    columns.col(i) = framed_ball(view, ball.center, ball.radius);
    overlay.color[0].col(i) = to_linear(ball.color);
  }
  overlay.radius[0] = columns.row(3);
  overlay.scene.add_balls(columns);
}

void lay_sticks(const std::vector<Stick>& sticks, const View& view, Overlay& overlay) {
  const auto count = static_cast<Eigen::Index>(sticks.size());
  Eigen::Matrix4Xf ends(4, 2 * count);
  overlay.color[1].resize(3, count);
  overlay.radius[1].resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Stick& stick = sticks[static_cast<std::size_t>(i)];
    require_finite(stick.a + stick.b, stick.radius, stick.color, fmt::format("stick {}", i));
    ends.col(2 * i) = framed_ball(view, stick.a, stick.radius);
    ends.col(2 * i + 1) = framed_ball(view, stick.b, stick.radius);
    overlay.radius[1](i) = ends(3, 2 * i);
    overlay.color[1].col(i) = to_linear(stick.color);
  }
  overlay.scene.add_sticks(ends);
}

/// The scene of one picture. It computes the colour of places in the picture.
struct Scene {
  Scene(const Panel& panel, const View& v, const RenderOptions& options)
      : view(v),
        eye(v.eye.cast<float>()),
        width(options.width),
        height(options.height),
        lights(v, options.light),
        surface(panel.shape, panel.vertex_colors, v),
        openness(surface, v, options.width, options.height, options.threads) {
    lay_balls(panel.balls, view, overlay);
    lay_sticks(panel.sticks, view, overlay);
    overlay.scene.commit();
  }

  /// What is seen at (x, y) [pixel], at most 1.
  Eigen::Vector3f seen(double x, double y) const {
    const Eigen::Vector3f ray = view.ray(x / width, y / height);
    Eigen::Vector3f color = Eigen::Vector3f::Ones();
    float depth = std::numeric_limits<float>::infinity();
    if (const auto hit = surface.scene().first_hit(eye, ray)) {
      const SurfacePoint point = surface.at(*hit, eye, ray);
      color = lights.shade(point.color, point.normal, openness.at(x, y, point));
      depth = hit->distance;
    }
    if (const auto hit = overlay.scene.first_hit(eye, ray)) {
      const float opacity = overlay_opacity(*hit, depth);
      color += opacity * (overlay_color(*hit, ray) - color);
    }
    return color.cwiseMin(1.0F);
  }

  float overlay_opacity(const Hit& hit, float depth) const {
    const float below =
        hit.distance - depth - kForgivenDepth * overlay.radius[hit.object](hit.element);
    return below <= 0 ? 1 : kHiddenOpacity * std::max(0.0F, 1 - below / kFadeDepth);
  }

  Eigen::Vector3f overlay_color(const Hit& hit, const Eigen::Vector3f& ray) const {
    Eigen::Vector3f normal = hit.normal.stableNormalized();
    if (normal.dot(ray) > 0) normal = -normal;
    const float light = 0.65F + 0.45F * std::max(0.0F, normal.dot(lights.key));
    return light * overlay.color[hit.object].col(hit.element);
  }

  View view;
  Eigen::Vector3f eye;
  int width, height;
  Lights lights;
  Surface surface;
  OpennessLattice openness;
  Overlay overlay;
};

/// The mean of samples² places in a pixel.
Eigen::Vector3f pixel(const Scene& scene, int x, int y, int samples) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int i = 0; i < samples * samples; ++i) {
    sum += scene.seen(x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples);
  }
  return sum / static_cast<float>(samples * samples);
}

/// Whether the colours of the pixel and those around it differ visibly.
bool has_contrast(const Image& image, int x, int y) {
  int least[3] = {255, 255, 255}, most[3] = {0, 0, 0};
  for (int v = std::max(0, y - 1); v <= std::min(y + 1, image.height - 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(x + 1, image.width - 1); ++u) {
      for (int c = 0; c < 3; ++c) {
        least[c] = std::min<int>(least[c], image.pixel(u, v)[c]);
        most[c] = std::max<int>(most[c], image.pixel(u, v)[c]);
      }
    }
  }
  return most[0] - least[0] > kContrast || most[1] - least[1] > kContrast ||
         most[2] - least[2] > kContrast;
}

// Whether one scale and one camera suit all panels. They do not in a sweep over shapes.
bool are_alike(const std::vector<Panel>& panels) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Panel& panel : panels) {
    if (panel.camera != panels[0].camera) return false;
    if (!panel.shape) continue;
    const double size = bounding_box_diagonal(panel.shape->V);
    least = std::min(least, size);
    most = std::max(most, size);
  }
  return panels.size() < 2 || most <= kAlike * least;
}

}  // namespace

Eigen::Matrix3Xd tinted(const Shape& shape, const std::vector<int>& vertices, const Color& color) {
  Eigen::Matrix3Xd all = colors::kSurface.replicate(1, shape.V.cols());
  for (const int v : vertices) {
    if (v < 0 || v >= shape.V.cols())
      throw InputError(fmt::format("cannot tint vertex {}: the shape has {}", v, shape.V.cols()));
    all.col(v) = color;
  }
  return all;
}

void add_balls(Panel& panel, const Eigen::Matrix3Xd& places, double radius, const Color& color) {
  for (const auto& place : places.colwise()) panel.balls.push_back({place, radius, color});
}

void add_graph(Panel& panel, const DeformationGraph& graph, const Eigen::Matrix3Xd& places,
               double radius) {
  add_balls(panel, places, radius, colors::kNode);
  for (const GraphEdge& edge : graph.edges)
    panel.sticks.push_back({places.col(edge.j), places.col(edge.k), radius / 3, colors::kEdge});
}

Eigen::Matrix3Xd extent(const std::vector<Panel>& panels) {
  std::vector<Eigen::Vector3d> points;
  for (const Panel& panel : panels) {
    if (panel.shape)
      for (const auto& v : panel.shape->V.colwise()) points.emplace_back(v);
    for (const Ball& ball : panel.balls) points.push_back(ball.center);
    for (const Stick& stick : panel.sticks) points.insert(points.end(), {stick.a, stick.b});
  }
  Eigen::Matrix3Xd P(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) P.col(static_cast<Eigen::Index>(i)) = points[i];
  return P;
}

Image render(const Panel& panel, const View& view, const RenderOptions& options) {
  if (options.samples < 1)
    throw InputError(
        fmt::format("cannot render with {} samples: at least 1 is needed", options.samples));
  const Scene scene(panel, view, options);
  Image image(options.width, options.height);
  Workers workers(options.threads);
  workers.each(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) store(pixel(scene, x, y, 1), image.pixel(x, y));
  });
  const Image rough = image;
  workers.each(image.height, [&](int y) {
    for (int x = 0; x < image.width && options.samples > 1; ++x) {
      if (!has_contrast(rough, x, y)) continue;
      store(pixel(scene, x, y, options.samples), image.pixel(x, y));
    }
  });
  return image;
}

std::vector<Image> render_alike(const std::vector<Panel>& panels, const RenderOptions& options) {
  const Eigen::Matrix3Xd all = extent(panels);
  std::vector<Image> images;
  for (const Panel& panel : panels) {
    const Camera& camera = panel.camera ? *panel.camera : options.camera;
    images.push_back(render(panel, frame(all, camera, options.width, options.height), options));
  }
  images = cropped_alike(images, options.width / 40);
  for (std::size_t i = 0; i < panels.size(); ++i)
    images[i] = with_caption(images[i], panels[i].caption);
  return images;
}

Image render_grid(const std::vector<Panel>& panels, const RenderOptions& options, int columns) {
  std::vector<Image> images;
  if (are_alike(panels)) {
    images = render_alike(panels, options);
  } else {
    for (const Panel& panel : panels) images.push_back(render_alike({panel}, options).front());
  }
  return grid(images, columns > 0 ? columns : std::max(1, static_cast<int>(panels.size())));
}

}  // namespace deformlab
