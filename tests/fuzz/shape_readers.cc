#include "drawing/drawing.h"
#include "geometry/graph/graph_file.h"
#include "geometry/shape/formats/format.h"
#include "geometry/shape/shape_io.h"
#include "tests/fuzz/readers.h"
#include "tests/support/shapes.h"

// Shapes, graphs and flat meshes.
namespace deformlab::fuzz {
namespace {

/// Reads a shape, writes it twice as large as a copy of its file, and reads the copy. Coordinates
/// may be rounded as the file declares, but doubling them changes no digit.
void read_and_rewrite(const std::string& extension, const std::string& bytes) {
  const std::filesystem::path file = put("shape" + extension, bytes);
  const std::filesystem::path copy = private_folder() / ("copy" + extension);
  Shape shape = read_shape(file);
  shape.V *= 2;
  write_shape(copy, shape, file);
  expect(read_shape(copy).V == shape.V, "a copy has the positions that were written");
}

Reader reader_of(const std::string& name, std::function<Texts()> samples, const Texts& words) {
  return {name, [name](const std::string& bytes) { read_and_rewrite("." + name, bytes); },
          std::move(samples), [words] { return words; }};
}

Shape plane() { return test::bumpy_plane(3); }

Texts off_samples() {
  return {formats::print_off(plane()), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n",
          "STCNOFF # a comment\n1 0 0\n0 0 0  0 0 1  1 1 1 1  0.5 0.5\n"};
}

Texts obj_samples() {
  return {formats::print_obj(plane()),
          "mtllib a.mtl\nv 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl a\n"
          "f 1/1/1 2/1/1 3//1\nf -3 -2 \\\n -1\nl 1 2\np 1\n",
          "v nan nan nan\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 2//1 3//1 4//1\n"};
}

Texts ply_samples() {
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\n";
  const std::string faces =
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string numbers = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string splats =
      "ply\nformat ascii 1.0\ncomment two splats\nelement vertex 2\nproperty double x\n"
      "property double y\nproperty double z\nproperty float nx\nproperty float ny\n"
      "property float nz\nproperty float rot_0\nproperty float rot_1\nproperty float rot_2\n"
      "property float rot_3\nend_header\n0 0 0 0 0 1 1 0 0 0\n1 2 3 1 0 0 0 1 0 0\n";
  std::string big = "ply\nformat binary_big_endian 1.0\n" + vertices +
                    "property float z\nelement face 0\nproperty list uchar int vertex_indices\n"
                    "end_header\n";
  big.append(36, '\0');  // three vertices
  return {formats::print_ply(plane()), "ply\nformat ascii 1.0\n" + vertices + faces + numbers,
          splats, big};
}

Texts stl_samples() {
  return {formats::print_stl(plane()),
          "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
          "endloop\nendfacet\nendsolid a\n"};
}

Texts xyz_samples() { return {formats::print_xyz(plane()), "# points\n0 0 0\n1 2 3\n"}; }

void read_hand_made_graph(const std::string& bytes) { read_graph(put("graph.obj", bytes)); }

Texts graph_samples() { return {"# a graph\no g\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 -1\n"}; }

void read_flat_mesh(const std::string& bytes) { read_drawing(put("flat.obj", bytes), {}); }

Texts flat_samples() {
  return {formats::print_obj(test::bumpy_plane(3, 1, 0)),
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"};
}

const Texts kObjWords{"v ", "vn ", "vt ", "f ",  "l ",    "p ",   "g ", "o ", "//",
                      "/",  "-1",  "#",   "nan", "1e300", "\\\n", "\n", "\r", "usemtl "};
const Texts kPlyWords{"ply\n",
                      "format ascii 1.0\n",
                      "format binary_little_endian 1.0\n",
                      "format binary_big_endian 1.0\n",
                      "element vertex ",
                      "element face ",
                      "property ",
                      "property list ",
                      "uchar ",
                      "char ",
                      "ushort ",
                      "short ",
                      "uint ",
                      "int ",
                      "float ",
                      "double ",
                      "float64 ",
                      "int8 ",
                      "vertex_indices\n",
                      "vertex_index\n",
                      "nx\n",
                      "ny\n",
                      "nz\n",
                      "rot_0\n",
                      "comment ",
                      "obj_info ",
                      "end_header\n",
                      "nan",
                      "4294967295",
                      "9223372036854775807"};

}  // namespace

std::vector<Reader> shape_readers() {
  return {reader_of("off", off_samples,
                    {"OFF", "STOFF", "COFF", "NOFF", "CNOFF", "4OFF", "nOFF", "BINARY", "#", "nan",
                     "1e300", "2147483648", "\n"}),
          reader_of("obj", obj_samples, kObjWords),
          reader_of("ply", ply_samples, kPlyWords),
          reader_of("stl", stl_samples,
                    {"solid ", "facet normal ", "outer loop\n", "vertex ", "endloop\n",
                     "endfacet\n", "endsolid", "nan", "1e39"}),
          reader_of("xyz", xyz_samples, {"#", "nan", "inf", ",", ";", "\t", "1e50", "\n"}),
          {"graph", read_hand_made_graph, graph_samples, [] { return kObjWords; }},
          {"flat_mesh", read_flat_mesh, flat_samples, [] { return kObjWords; }}};
}

}  // namespace deformlab::fuzz
