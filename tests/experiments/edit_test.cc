#include "experiments/subjects/shape/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "geometry/core/error.h"
#include "tests/support/errors.h"

namespace deformlab {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Vertices 0..4 along x, at y = z = 0.
Shape row_of_five() {
  Shape shape;
  shape.V.setZero(3, 5);
  shape.V.row(0) = Eigen::RowVectorXd::LinSpaced(5, 0, 4);
  return shape;
}

std::vector<EditEntry> read(const std::string& text) {
  return read_edit(parse_yaml(
      text, std::make_shared<const ConfigSource>(ConfigSource{"e.yaml", ::testing::TempDir()})));
}

ResolvedEdit resolved(const std::string& text) { return resolve(read(text), row_of_five()); }

/// The message of the InputError that reading and resolving gives, or "" where it gives none.
std::string error_of(const std::string& text) {
  return test::error_of([&] { resolved(text); });
}

std::filesystem::path write(const std::string& name, const std::string& text) {
  std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path;
}

Eigen::Vector3d point(double x, double y, double z) { return {x, y, z}; }

TEST(Edit, SelectsByEveryKind) {
  const auto moved = [](const std::string& select) {
    return resolved("- {select: {" + select + "}, by: [0, 0, 1]}").handles.moved;
  };
  EXPECT_THAT(moved("vertices: [3, 1, 3]"), ElementsAre(1, 3));
  EXPECT_THAT(moved("box: {min: [1, -1, 0], max: [2, 1, 0]}"), ElementsAre(1, 2));
  EXPECT_THAT(moved("sphere: {center: [4, 0, 0], radius: 1}"), ElementsAre(3, 4));
  EXPECT_THAT(moved("sphere: {center: [4, 0, 0], radius: 0}"), ElementsAre(4));
  EXPECT_THAT(moved("nearest: [2.2, 9, 0]"), ElementsAre(2));
  EXPECT_THAT(moved("all: true"), ElementsAre(0, 1, 2, 3, 4));
  write("handles.txt", "4\r\n\n  0 \n");
  EXPECT_THAT(moved("file: handles.txt"), ElementsAre(0, 4));
}

TEST(Edit, KeepsTheOrderOfEntriesThenOfIndices) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [4]}, by: [0, 1, 0]}\n"
      "- {select: {vertices: [3, 1]}, fix: true}\n"
      "- {select: {vertices: [1, 0]}, fix: true}\n"
      "- {select: {nearest: [2, 0, 0]}, to: [7, 8, 9]}\n");
  EXPECT_THAT(edit.handles.moved, ElementsAre(4, 2));
  EXPECT_THAT(edit.handles.fixed, ElementsAre(1, 3, 0));
  ASSERT_EQ(edit.targets.cols(), 2);
  EXPECT_EQ(edit.targets.col(0), point(4, 1, 0));
  EXPECT_EQ(edit.targets.col(1), point(7, 8, 9));
}

TEST(Edit, FixAloneMovesNothing) {
  const ResolvedEdit edit = resolved("- {select: {all: true}, fix: true}");
  EXPECT_EQ(edit.handles.fixed.size(), 5u);
  EXPECT_THAT(edit.handles.moved, IsEmpty());
  EXPECT_EQ(edit.targets.cols(), 0);
}

TEST(Edit, ToCarriesSeveralVerticesByTheirCentroid) {
  const ResolvedEdit edit = resolved("- {select: {vertices: [1, 3]}, to: [2, 5, 0]}");
  EXPECT_LT((edit.targets.col(0) - point(1, 5, 0)).norm(), 1e-14);
  EXPECT_LT((edit.targets.col(1) - point(3, 5, 0)).norm(), 1e-14);
}

TEST(Edit, RotatesByTheRightHandRuleThenTranslates) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [2]}, by: [0, 0, 1],\n"
      "   rotate: {axis: [0, 0, 5], degrees: 90, center: [1, 0, 0]}}\n"
      "- {select: {vertices: [0, 4]}, rotate: {axis: [0, 1, 0], degrees: 90}}\n");
  EXPECT_LT((edit.targets.col(0) - point(1, 1, 1)).norm(), 1e-14);
  EXPECT_LT((edit.targets.col(1) - point(2, 0, 2)).norm(), 1e-14);
  EXPECT_LT((edit.targets.col(2) - point(2, 0, -2)).norm(), 1e-14);
}

TEST(Edit, RefusesContradictions) {
  EXPECT_EQ(error_of("- {select: {vertices: [1, 2]}, fix: true}\n"
                     "- {select: {nearest: [2, 0, 0]}, by: [0, 0, 1]}"),
            "vertex 2 is fixed by edit entry 1 (line 1 of e.yaml) and moved by edit entry 2 "
            "(line 2 of e.yaml); take it out of one of the selections");
  EXPECT_THAT(error_of("- {select: {nearest: [2, 0, 0]}, by: [0, 0, 1]}\n"
                       "- {select: {vertices: [1, 2]}, fix: true}"),
              HasSubstr("vertex 2 is fixed by edit entry 2 (line 2 of e.yaml) and moved by edit "
                        "entry 1 (line 1 of e.yaml)"));
  EXPECT_THAT(error_of("- {select: {vertices: [2]}, by: [0, 0, 1]}\n"
                       "- {select: {vertices: [2]}, by: [0, 0, 2]}"),
              HasSubstr("vertex 2 is moved to [2, 0, 1] by edit entry 1 (line 1 of e.yaml) and to "
                        "[2, 0, 2] by edit entry 2 (line 2 of e.yaml)"));
}

TEST(Edit, MovedTwiceToOnePlaceCountsOnce) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [2, 3]}, by: [0, 0, 1]}\n"
      "- {select: {vertices: [2]}, to: [2, 0, 1]}");
  EXPECT_THAT(edit.handles.moved, ElementsAre(2, 3));
  EXPECT_EQ(edit.targets.cols(), 2);
}

TEST(Edit, RefusesVerticesThatDoNotExist) {
  EXPECT_EQ(error_of("\n- {select: {vertices: [0, 5]}, fix: true}"),
            "edit entry 1 (line 2 of e.yaml): vertex 5 does not exist; the shape has 5 vertices, "
            "counted from 0");
  EXPECT_THAT(error_of("- {select: {vertices: [-1]}, fix: true}"), HasSubstr("vertex -1"));
}

TEST(Edit, EmptySelectionTellsWhereTheShapeIs) {
  const std::string shape_is = "shape reaches from [0, 0, 0] to [4, 0, 0]";
  EXPECT_THAT(error_of("- {select: {box: {min: [5, 0, 0], max: [9, 1, 1]}}, fix: true}"),
              AllOf(HasSubstr("edit entry 1 (line 1 of e.yaml) selects no vertex"),
                    HasSubstr(shape_is), HasSubstr("unit")));
  EXPECT_THAT(error_of("- {select: {vertices: []}, fix: true}"), HasSubstr(shape_is));
  write("none.txt", "\n");
  EXPECT_THAT(error_of("- {select: {file: none.txt}, fix: true}"), HasSubstr(shape_is));
}

TEST(Edit, EntriesNeedOneSelectorAndOneAction) {
  const std::string one = "- {select: {all: true}, ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"- {select: {}, fix: true}",
       "exactly one of vertices, box, sphere, nearest, point, file, all"},
      {"- {select: {all: true, nearest: [0, 0, 0]}, fix: true}", "all; found 2"},
      {"- {select: {all: false}, fix: true}", "'all' can only be true"},
      {one + "fix: false}", "'fix' can only be true"},
      {"- {select: {all: true}}",
       "needs exactly one of fix, to, matrix, targets, or any of scale, rotate and by"},
      {one + "fix: true, by: [0, 0, 1]}", "found several"},
      {one + "to: [0, 0, 1], by: [0, 0, 1]}", "found several"},
      {one + "to: [0, 0, 1], rotate: {axis: [0, 0, 1], degrees: 1}}", "found several"},
      {"- {fix: true}", "missing key 'select'"},
      {one + "move: [0, 0, 1]}", "unknown key 'move'"},
      {"- {select: {sfere: 1}, fix: true}", "did you mean 'sphere'?"},
      {"- {select: {box: {min: [0, 0, 0]}}, fix: true}", "missing key 'max'"},
      {"- 3", "'edit[0]'"},
      {"{a: 1}", "wrong value for 'edit'"},
      {"[]", "'edit' has no entries"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_THAT(error_of("\n" + text), AllOf(HasSubstr(message), HasSubstr("line 2 of e.yaml")))
        << text;
  }
  EXPECT_THAT([] { resolve({}, row_of_five()); }, ::testing::Throws<InputError>());
  const auto fix_all = read("- {select: {all: true}, fix: true}");
  EXPECT_THAT([&] { resolve(fix_all, Shape{}); }, ::testing::Throws<InputError>());
}

TEST(Edit, RefusesImpossibleNumbers) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{select: {sphere: {center: [0, 0, 0], radius: -0.5}}, fix: true}", "radius is -0.5"},
      {"{select: {box: {min: [0, 2, 0], max: [1, 1, 1]}}, fix: true}", "min [0, 2, 0]"},
      {"{select: {all: true}, rotate: {axis: [0, 0, 0], degrees: 1}}", "axis must not be"},
      {"{select: {all: true}, by: [0, .nan, 0]}", "'edit[0].by[1]'"},
      {"{select: {nearest: [0, 0, .inf]}, fix: true}", "expected a finite number"},
      {"{select: {all: true}, by: [1.7e308, 0]}", "a list of 3 numbers"},
      {"{select: {vertices: [1.5]}, fix: true}", "'edit[0].select.vertices[0]'"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_THAT(error_of("- " + text), AllOf(HasSubstr(message), HasSubstr("line 1 of e.yaml")))
        << text;
  }
  EXPECT_THAT(error_of("- {select: {all: true}, by: [1.7e308, 0, 0],\n"
                       "   rotate: {axis: [0, 1, 0], degrees: 180, center: [1.7e308, 0, 0]}}"),
              HasSubstr("beyond the range of numbers"));
}

TEST(Edit, FilesOfIndicesAreCheckedByLine) {
  write("words.txt", "1\n2 3\n");
  EXPECT_THAT(error_of("- {select: {file: words.txt}, fix: true}"),
              AllOf(HasSubstr("line 2 of"), HasSubstr("words.txt"), HasSubstr("'2 3'")));
  EXPECT_THAT(error_of("- {select: {file: absent.txt}, fix: true}"),
              AllOf(HasSubstr("edit entry 1 (line 1 of e.yaml)"), HasSubstr("absent.txt")));
  EXPECT_THAT(error_of("- {select: {file: .}, fix: true}"), HasSubstr("cannot read"));
}

TEST(Edit, ContradictionsBetweenTargetsNameTheirLines) {
  write("twice.csv", "vertex,x,y,z\n2,0,0,1\n2,0,0,2\n");
  EXPECT_THAT(error_of("- {targets: twice.csv}"),
              AllOf(HasSubstr("line 2 of twice.csv"), HasSubstr("line 3 of twice.csv")));
  write("many.csv", "9,0,0,1\n");
  EXPECT_THAT(error_of("- {targets: many.csv}"),
              AllOf(HasSubstr("line 1 of many.csv"), HasSubstr("vertex 9")));
}

TEST(Edit, SaysThatAMatrixMirrorsOrFlattens) {
  const auto notes = [](const char* rows) {
    return resolved(std::string("- {select: {all: true}, matrix: [") + rows + ", [0, 0, 0, 1]]}")
        .notes;
  };
  EXPECT_THAT(notes("[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]"), IsEmpty());
  EXPECT_THAT(notes("[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]"),
              ElementsAre(HasSubstr("flattens")));
  EXPECT_THAT(notes("[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0]"),
              ElementsAre(HasSubstr("mirrors")));
}

TEST(Edit, RefusesAPointFarFromTheShape) {
  EXPECT_EQ(error_of("- {select: {point: [1.5, 0, 3.9]}, by: [0, 0, 1]}"), "");
  EXPECT_THAT(error_of("- {select: {point: [1.5, 0, 40]}, by: [0, 0, 1]}"),
              AllOf(HasSubstr("line 1 of e.yaml"), HasSubstr("40 away"), HasSubstr("[4, 0, 0]")));
}

TEST(Edit, ReadsAFileThatHoldsNothingElse) {
  write("ids.txt", "3\n");
  const std::string text = "edit:\n- select: {file: ids.txt}\n  by: [0, 0, 1]\n";
  const auto read_edit_file = [](const std::filesystem::path& path) {
    ConfigNode root;
    root.kind = ConfigNode::Kind::kMap;
    put_edit(path, root);
    return read_edit(*root.find("edit"));
  };
  const std::vector<EditEntry> entries = read_edit_file(write("good_edit.yaml", text));
  EXPECT_THAT(entries.at(0).where, AllOf(HasSubstr("line 2 of"), HasSubstr("good_edit.yaml")));
  EXPECT_THAT(resolve(entries, row_of_five()).handles.moved, ElementsAre(3));
  EXPECT_THAT([&] { read_edit_file(write("more_edit.yaml", text + "nodes: 3\n")); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("unknown key 'nodes' (line 4")));
  EXPECT_THAT([&] { read_edit_file(write("no_edit.yaml", "{}")); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("missing key 'edit'")));
}

}  // namespace
}  // namespace deformlab
