#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "solvers/stopwatch.h"

namespace deformlab {

/// The time of one call [ms].
template <class Action>
double ms_of(Action&& action) {
  double seconds = 0;
  {
    Stopwatch watch(seconds);
    action();
  }
  return 1e3 * seconds;
}

/// The result of one run of one way.
struct RunResult {
  double ms = 0;  ///< the time that is compared
  /// Further figures of the same run, by name. Their medians are reported.
  std::vector<std::pair<std::string, double>> parts;
  std::string status;     ///< how the solve ended; empty if nothing was solved
  std::string blas;       ///< the BLAS that the solver used; empty if it used none
  std::size_t steps = 0;  ///< of the solve
  double cost = 0;        ///< F of the result
};

/// A way to do the work. `run` does it once, without what can be prepared before.
struct Way {
  std::string name;  ///< with all settings that are not defaults
  std::function<RunResult()> run;
};

/// Two ways of the same work, for each number of nodes or vertices in `sizes`.
struct Scenario {
  std::string name;
  std::string against;  ///< what it is compared with
  std::string unit;     ///< what a size counts
  std::vector<int> sizes;
  std::function<Way(int size)> ours, theirs;
  int rounds = 1;  ///< how often the pair is measured for each repetition that the user asks for
  /// How often our way is then measured by itself for each repetition, for its slowest runs.
  int alone = 0;
};

/// The middle value and the extremes.
struct Spread {
  double median = 0, least = 0, most = 0;
};

/// The spread of at least one value. The median of an even number of values is the mean of the two
/// middle ones.
Spread spread(std::vector<double> values);

/// The least of the values that a share p of them, above 0 and at most 1, does not exceed.
double quantile(std::vector<double> values, double p);

/// A scenario measured at one size: ours.ms[i] and theirs.ms[i] were measured one after the other.
struct Measurement {
  struct Side {
    std::string way;
    std::vector<double> ms;
    std::vector<std::pair<std::string, std::vector<double>>> parts;
    RunResult last;
    std::vector<double> alone_ms{};  ///< further runs, without the other way in between
  };
  std::string scenario, against, unit;
  int size = 0;
  Side ours, theirs;

  Spread ratio() const;       ///< of theirs.ms[i] / ours.ms[i]: how many times as fast ours is
  bool same_minimum() const;  ///< whether both costs agree to 1e-6, relative to ours
};

/// Runs both ways in turns, so that other work of the machine slows both. Our way runs once before
/// that, without being measured. If one of a pair takes more than three seconds, the pair is
/// measured once.
Measurement measure(const Scenario& scenario, int size, int repetitions);

}  // namespace deformlab
