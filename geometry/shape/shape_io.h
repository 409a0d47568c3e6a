#pragma once

#include <filesystem>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Reads a shape; the extension tells the format: .off .obj .ply .stl .xyz, in any case.
/// Vertices keep the file's number and order, faces their corners; nothing is merged or repaired.
///   OFF  text; C, N and ST are known. N is read from NOFF.
///   OBJ  N is read where there are as many vn as v and each corner uses one index for both.
///   PLY  ascii or binary of either byte order. N is read from nx, ny, nz of the vertices.
///   STL  ascii or binary. It has no shared vertices: corners with equal coordinates become one
///        vertex, numbered in the order of their first appearance. Its facet normals are not read.
///   XYZ  a point a line. Columns 4 to 6 are N where all have unit length within 1 %.
/// Normals are normalised. Throws InputError where the file cannot be read whole, or `check` does.
/// (OBJ and XYZ do not say how long they are: one that was cut between two lines is read.)
Shape read_shape(const std::filesystem::path& path);

/// Writes a shape in the format that the extension of `out` tells: whole, or not at all.
///
/// With a `source` of the same format, the file that the shape was read from, `out` is a copy of it
/// in which only the positions change, and the normals where it has normals. So its faces, colours,
/// texture coordinates, materials, groups, comments and further properties stay, whatever they are;
/// numbers that did not change keep their digits, others get as many as a round trip needs (in PLY
/// and binary STL in the precision that the file declares). Normals that shape.N does not give are
/// left out; this takes in those of an OBJ that are not one a vertex. STL's are made anew.
///
/// Otherwise positions and faces are written, and normals except to STL; nothing else is carried
/// over. PLY and STL are then binary. STL takes faces only, cut into triangles, in float32; XYZ
/// takes no faces; in OBJ faces of one or two corners become points and lines.
///
/// `out` may be `source`. Throws InputError where `shape` fails `check`, does not fit `source`, or
/// cannot be written.
void write_shape(const std::filesystem::path& out, const Shape& shape,
                 const std::filesystem::path& source = {});

/// Throws InputError where the extension of `out` tells no format to write.
void check_extension(const std::filesystem::path& out);

}  // namespace deformlab
