#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace deformlab {

/// The exponent p of time ~ nodes^p. It is fitted by least squares to the logarithms of the points
/// (nodes, time).
double exponent(const std::vector<std::pair<double, double>>& points);

/// Prints what Google Benchmark's console reporter prints, and keeps the figures for the report.
class GrowthReporter final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;

  /// A Markdown table of all runs, and one of how each family grows: our fitted exponent beside
  /// Google Benchmark's fit.
  std::string to_markdown() const;

 private:
  struct Row {
    std::string name;
    double ms;
    std::string rest;
  };
  struct Family {
    std::vector<std::pair<double, double>> points;  // nodes, time
    std::string big_o;
  };
  std::vector<Row> rows_;
  std::map<std::string, Family> families_;
};

}  // namespace deformlab
