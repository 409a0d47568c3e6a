#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace deformlab {

/// A bumpy plane of side² vertices, deformed as the reference scene is by the default solver, from
/// registration on.
struct Scale {
  int vertices = 0, nodes = 0, handles = 0;
  double register_ms = 0, compile_ms = 0, update_ms = 0;  ///< update: without the transfer
  double positions_ms = 0, normals_ms = 0;                ///< Eq. 2 and 3 of the whole shape
  double copy_ms = 0;                                     ///< of the bytes that either touches
  std::size_t steps = 0;
  int cg_iterations = 0;
  double cost = 0;
  std::string linear_solver, status;
  double peak_bytes = 0;  ///< that compilation and update take at most, beside what was there

  double to_convergence_ms() const { return compile_ms + update_ms; }
};

/// Medians of so many runs; the registration is run once.
Scale scale(int side, int nodes, int repetitions);

/// The exponent p of the time to convergence ~ nodes^p, by least squares in log-log.
double growth(const std::vector<Scale>& all);

/// Graphs of growing size on one shape, the growth and what it should be at most; then a million
/// vertices, with what registration and transfer take beside each other.
std::string to_markdown(const std::vector<Scale>& growing, const std::vector<Scale>& large);

nlohmann::ordered_json to_json(const std::vector<Scale>& growing, const std::vector<Scale>& large);

}  // namespace deformlab
