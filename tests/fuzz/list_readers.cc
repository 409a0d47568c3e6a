#include <fmt/format.h>
#include <gflags/gflags.h>

#include <filesystem>
#include <sstream>

#include "experiments/commands/flags.h"
#include "experiments/commands/manifest.h"
#include "experiments/commands/results.h"
#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/animation/resume_file.h"
#include "experiments/subjects/particles/particle_cache.h"
#include "experiments/subjects/shape/edit_files.h"
#include "tests/fuzz/readers.h"
#include "tests/support/animations.h"

// Tables of numbers, and the files that runs leave for later runs.
namespace deformlab::fuzz {
namespace {

const Texts kNumberWords{",", ";", "\t", "#", "nan", "inf", "-0", "1e300", "2147483648", "\r\n"};

void read_index_file(const std::string& bytes) {
  read_indices(put("indices.txt", bytes), "edit entry 1");
}

template <int dimension>
void read_target_file(const std::string& bytes) {
  read_targets(put("targets.csv", bytes), dimension, "edit entry 1");
}

/// Reads particles as a run does: all rows, the path that carries the graph, and the rows again
/// with other positions.
void read_particles(const std::string& bytes) {
  const ParticleCache cache(put("particles.csv", bytes));
  for (ParticleReader rows(cache.path()); const auto row = rows.next();) {
    rows.moved(row->position + Eigen::Vector3d::Ones());
  }
  sample_path(cache, find_path(cache, {}), 5);
}

/// A command line with one argument a line.
void read_flags(const std::string& bytes) {
  const gflags::FlagSaver flags;  // the next input finds the flags as this one did
  std::vector<std::string> arguments;
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) arguments.push_back(line);
  const std::size_t words = parse_flags(arguments).words.size();
  expect(words <= arguments.size(), "each word is an argument");
}

void read_frame_pattern(const std::string& bytes) {
  const FramePattern pattern(bytes, "--frames");
  for (const FrameNumber frame : {0L, 7L, 123456L}) {
    const std::filesystem::path path = pattern.path(frame);
    expect(pattern.frame_of(path.filename().string()) == frame, "a pattern finds its own frames");
  }
}

void read_manifest(const std::string& bytes) {
  put(kManifest, bytes);
  const Manifest manifest(private_folder());
  manifest.is_complete();
  manifest.check_free({"picture.png", "frames/0.png"});
}

/// A resume file with the fingerprint "1a2b" of a run that has written nothing.
void read_resume_file(const std::string& bytes) {
  const FramePattern out((private_folder() / "out-%03d.obj").string(), "--out");
  put(std::string("out-%03d.obj") + kProgressEnding, bytes);
  const ResumeFile file(out, "1a2b");
  file.has(0);
}

Texts resume_samples() {
  put("out-000.obj", "v 0 0 0\n");
  const std::string head =
      "deformlab animate was stopped: the next run goes on after these frames. Delete this file "
      "to start over.\nfingerprint 1a2b\n";
  return {head + "frame 0 8 0123456789abcdef\nframe 1 99 0\n", head};
}

/// The measurements of an earlier run, from which the page of all results is made.
void read_metrics(const std::string& bytes) {
  const std::filesystem::path results = private_folder() / "results";
  std::filesystem::create_directories(results / "a");
  put("results/a/metrics.json", bytes);
  write_gallery(results);
}

Texts metrics_samples() {
  return {R"({"title": "a", "paper": "b", "runs": [{"metrics": {"vertices": 9, "nodes": 3}}],)"
          R"( "claims": [{"name": "c", "says": "d", "measured": 1.5, "expected": "e", "holds": )"
          R"(true, "known": ""}, {"name": "f", "measured": null}]})"};
}

}  // namespace

std::vector<Reader> list_readers() {
  const auto numbers = [] { return kNumberWords; };
  return {
      {"indices", read_index_file, [] { return Texts{"0\n12\r\n\n  3 \n"}; }, numbers},
      {"targets", read_target_file<3>,
       [] {
         return Texts{"vertex,x,y,z\n0,1,2,3\n", "# places\n0 0 0 1 1 1\n5;1;2;3e0\n"};
       },
       numbers},
      {"plane_targets", read_target_file<2>,
       [] {
         return Texts{"vertex,x,y\n0,1,2\n", "0 0 1 1\n"};
       },
       numbers},
      {"particles", read_particles,
       [] {
         return Texts{test::particle_csv(4),
                      "Y,Z,name,X,Frame,Id\r\n1,2,\"a,b\",3,0,7\r\n2,2,c,nan,0,8\r\n"
                      "4,4,\"d\"\"e\",9,1,7\r\n"};
       },
       [] { return Texts{"frame", "id", "x", "y", "z", ",", "\"", "\"\"", "nan", "\r", "+1"}; }},
      {"flags", read_flags,
       [] { return Texts{"deform\na.obj\n--out=b.obj\n-edit\nc.yaml\n--strict\n--nodes\n99\n"}; },
       [] {
         return Texts{"--", "\n--nodes", "\n--strict=", "\n--out=", "-1", "true", "2147483648"};
       }},
      {"frame_pattern", read_frame_pattern,
       [] {
         return Texts{"horse-%03d.obj", "a/b%d"};
       },
       [] { return Texts{"%d", "%0", "%%", "%03d", "/", "..", ".obj"}; }},
      {"manifest", read_manifest,
       [] {
         return Texts{Manifest::text({"picture.png", "frames/0.png"})};
       },
       [] {
         return Texts{"picture.png\n", "frames", "/", "..", "\n"};
       }},
      {"resume", read_resume_file, resume_samples,
       [] {
         return Texts{"frame ", "fingerprint 1a2b\n", "18446744073709551615", "-1"};
       }},
      {"metrics", read_metrics, metrics_samples, [] {
         return Texts{"\"title\"", "\"paper\"",   "\"runs\"",   "\"metrics\"",  "\"vertices\"",
                      "\"nodes\"", "\"handles\"", "\"claims\"", "\"measured\"", "\"says\"",
                      "\"known\"", "\"holds\"",   "null",       "true",         "[",
                      "]",         "{",           "}",          "1e999",        "\\u0000",
                      "\\ud800"};
       }}};
}

}  // namespace deformlab::fuzz
