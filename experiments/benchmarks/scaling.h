#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace deformlab {

/// Registration, compilation, update and transfer of a bumpy plane of side² vertices. It is
/// deformed like the reference scene, by the default solver.
struct Scale {
  int vertices = 0, nodes = 0, handles = 0;
  double register_ms = 0, compile_ms = 0, update_ms = 0;  ///< the update is without the transfer
  double positions_ms = 0, normals_ms = 0;                ///< Eq. 2 and 3 of the whole shape
  double copy_ms = 0;  ///< copies as many bytes as one transfer touches
  std::size_t steps = 0;
  int cg_iterations = 0;
  double cost = 0;
  std::string linear_solver, status;
  double peak_bytes = 0;  ///< the most that compilation and update add to the memory in use

  double to_convergence_ms() const { return compile_ms + update_ms; }
};

/// The medians of `repetitions` runs. The registration runs once.
Scale scale(int side, int nodes, int repetitions);

/// The exponent p of the time to convergence ~ nodes^p, by least squares of the logarithms.
double growth(const std::vector<Scale>& all);

/// A Markdown table of graphs of growing size on one shape, with the exponent, and one of a million
/// vertices, which compares the times of registration and transfer.
std::string to_markdown(const std::vector<Scale>& growing, const std::vector<Scale>& large);

nlohmann::ordered_json to_json(const std::vector<Scale>& growing, const std::vector<Scale>& large);

}  // namespace deformlab
