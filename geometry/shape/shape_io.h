#pragma once

#include <filesystem>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Reads a shape. The extension determines the format: .off .obj .ply .stl .xyz, in either case.
/// Vertices and faces keep the file's order, and nothing is merged or repaired except in STL.
///   OFF  text with the prefixes ST, C and N; N is read from NOFF.
///   OBJ  N is read where there are as many vn as v and each corner uses one index for both.
///        Faces of one or two corners are left out.
///   PLY  ascii or binary of either byte order. N is read from nx, ny, nz of the vertices.
///   STL  ascii or binary. It has no shared vertices: corners with equal coordinates become one
///        vertex, numbered in the order of their first appearance. Its facet normals are not read.
///   XYZ  one point per line. Columns 4 to 6 are N where all have unit length within 1 %.
/// Normals are normalised. Throws InputError where the file cannot be read to its end or `check`
/// throws. OBJ and XYZ do not state their length: a file that was cut between lines is read.
///
/// `notes` gets a sentence for each thing that the user should know: vertices without a position
/// (NaN), which the shape does not contain, and what the file contains that the library does not
/// know.
Shape read_shape(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr);

/// Writes a shape in the format that the extension of `out` determines, whole or not at all.
///
/// `source` is the file that the shape was read from. If it has the same format, `out` is a copy of
/// it in which only the positions change, and the normals where it has normals. Its faces, colours,
/// materials, comments and all other contents stay. Numbers that did not change keep their digits,
/// and others get as many as a round trip needs (in PLY and binary STL in the precision that the
/// file declares). Normals that shape.N does not contain are left out. Facet normals of STL are
/// computed anew. Normals of an OBJ that belong to corners, and vectors and quaternions of a PLY,
/// turn with their vertices (`local_rotations`). Vertices without a position stay as they are.
///
/// Otherwise positions, faces and normals are written and nothing else. Vertices of `source`
/// without a position are written as NaN, except to STL. PLY and STL are then binary. STL contains
/// only faces, cut into triangles, in float32; XYZ contains no faces; in OBJ faces of one or two
/// corners become points and lines.
///
/// `out` may be `source`. Throws InputError where `check` throws, where the shape does not fit
/// `source`, or where the file cannot be written.
void write_shape(const std::filesystem::path& out, const Shape& shape,
                 const std::filesystem::path& source = {});

/// Throws InputError where no format has the extension of `out`.
void check_extension(const std::filesystem::path& out);

/// Whether a format has the extension of `path`, so that read_shape can read it.
bool is_shape_file(const std::filesystem::path& path);

}  // namespace deformlab
