#include "experiments/subjects/drawing/drawing_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "drawing/following_parts.h"
#include "experiments/subjects/shape/paint.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/plane/locator.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kClipArt[] = {"/usr/share/openclipart/svg", "/usr/share/openclipart/png"};

fs::path find_drawing(const std::string& file, const fs::path& folder) {
  std::vector<fs::path> places{folder / file, fs::path(file)};
  for (const char* package : kClipArt) places.push_back(fs::path(package) / file);
  for (const fs::path& place : places) {
    std::error_code ignored;
    if (fs::exists(place, ignored) && !fs::is_directory(place, ignored)) return place;
    if (!file.empty() && fs::is_directory(place, ignored))
      cannot_read(place, "it is a folder; name a file in it");
  }
  throw InputError(
      fmt::format("drawing.file '{}' is neither beside the config, nor in the working folder, nor "
                  "in the packages openclipart-svg and openclipart-png",
                  file));
}

// For each triangle: whether all its corners are selected.
std::vector<char> triangles_of(const std::vector<int>& vertices, const Triangulation& mesh) {
  std::vector<char> selected(static_cast<std::size_t>(mesh.V.cols()), 0), result;
  for (const int i : vertices) selected[i] = 1;
  for (const auto f : mesh.F.colwise()) {
    result.push_back(selected[f[0]] && selected[f[1]] && selected[f[2]]);
  }
  return result;
}

// For each triangle: whether the mask is dark at its centre.
std::vector<char> triangles_under(const Bitmap& mask, const Page& page, const Triangulation& mesh) {
  std::vector<char> result;
  for (const auto f : mesh.F.colwise()) {
    const Eigen::Vector2d center = (mesh.V.col(f[0]) + mesh.V.col(f[1]) + mesh.V.col(f[2])) / 3;
    const Eigen::Vector2d share = (center - page.min()).cwiseQuotient(page.diagonal());
    const int x = static_cast<int>(share.x() * mask.width);
    const int y = static_cast<int>(share.y() * mask.height);
    const bool inside = x >= 0 && y >= 0 && x < mask.width && y < mask.height;
    const std::uint8_t* p = inside ? mask.pixel(x, y) : nullptr;
    result.push_back(p && p[3] > 127 && p[0] + p[1] + p[2] < 3 * 128);
  }
  return result;
}

std::vector<ReadCoat> plane_coats(const ConfigNode& list) {
  return with_circles([&] { return read_coats(in_space(list)); });
}

std::vector<char> painted(const ReadCoat& read, const DrawingScene& scene) {
  if (read.coat.mask) {
    if (extension_of(*read.coat.mask) != ".png")
      throw InputError(
          fmt::format("{}: the mask '{}' must be a PNG", read.where, read.coat.mask->string()));
    return triangles_under(read_png(read.folder / *read.coat.mask), scene.drawing.page, scene.rest);
  }
  const Shape shape = to_shape(scene.rest);
  Selection select = *read.coat.select;
  select.dimension = 2;
  return triangles_of(select_vertices(select, shape, read.where), scene.rest);
}

// The detached parts that an entry of the edit selects something of, in ascending order.
std::set<std::size_t> parts_with_handles(const DrawingScene& scene,
                                         const std::vector<EditEntry>& edit) {
  std::set<std::size_t> result;
  if (scene.following.empty()) return result;
  Triangulation all = scene.rest;
  std::vector<Eigen::Index> first;  // vertex of each part
  for (const Triangulation& part : scene.following) {
    first.push_back(all.V.cols());
    append(part, all);
  }
  const auto take = [&](Eigen::Index vertex) {
    const auto after = std::ranges::upper_bound(first, vertex) - first.begin();
    if (after > 0) result.insert(static_cast<std::size_t>(after - 1));
  };
  const Locator locate(all);
  const Shape shape = to_shape(all);
  for (const EditEntry& entry : edit) {
    if (!entry.selection) continue;
    const Selection& select = *entry.selection;
    if (select.point) take(all.F(0, locate(select.point->head<2>()).triangle));
    if (!select.box && !select.sphere && !select.nearest) continue;
    for (const int vertex : select_vertices(select, shape, entry.where)) take(vertex);
  }
  return result;
}

std::set<std::size_t> every_part(const std::vector<Triangulation>& parts) {
  std::set<std::size_t> result;
  for (std::size_t i = 0; i < parts.size(); ++i) result.insert(i);
  return result;
}

// Makes parts of the mesh of those detached parts that do not follow it.
void take_own_parts(const std::set<std::size_t>& own, DrawingScene& scene) {
  std::vector<Triangulation> following;
  for (std::size_t i = 0; i < scene.following.size(); ++i) {
    if (own.contains(i)) {
      append(scene.following[i], scene.rest);
    } else {
      following.push_back(std::move(scene.following[i]));
    }
  }
  scene.following = std::move(following);
}

}  // namespace

DrawingScene make_drawing(const DrawingSceneOptions& options, const fs::path& folder,
                          const std::vector<EditEntry>& edit, const CutLines& cuts) {
  DrawingScene scene;
  scene.path = find_drawing(options.file, folder);
  scene.drawing = read_drawing(scene.path, options.reading, cuts);
  const std::string name = scene.path.string();
  scene.rest = scene.drawing.mesh ? *scene.drawing.mesh
                                  : triangulate(scene.drawing.region, options.mesh, name);
  scene.following = meshes_of(scene.drawing.detached, scene.rest);
  const bool all = options.reading.parts == DetachedParts::kOwn;
  take_own_parts(all ? every_part(scene.following) : parts_with_handles(scene, edit), scene);
  scene.weights.setOnes(scene.rest.F.cols());
  return scene;
}

void paint(DrawingScene& scene, const ConfigNode& list) {
  for (const ReadCoat& read : plane_coats(list)) {
    const std::vector<char> chosen = painted(read, scene);
    bool any = false;
    for (Eigen::Index f = 0; f < scene.weights.size(); ++f) {
      if (!chosen[f]) continue;
      any = true;
      scene.weights[f] = read.coat.weight;
    }
    if (!any) throw InputError(fmt::format("{} paints no triangle; make it larger", read.where));
  }
}

void check_paint(const ConfigNode& list) { plane_coats(list); }

}  // namespace deformlab
