#include "allan_self_test.h"

#include <cmath>

#include "allan_source.h"
#include "vispline/results/table.h"

namespace vispline::cli {
namespace {

struct Truth {
  std::size_t signal;  ///< of the analysis: gyroscope, accelerometer
  Term term;
  double value;
};

struct Sums {
  int resolved = 0, covered = 0, bounds = 0;
  double value = 0.0, square = 0.0, bound = 0.0;

  void add(const TermEstimate& estimate, double truth) {
    if (estimate.resolved) {
      ++resolved;
      value += estimate.value;
      square += estimate.value * estimate.value;
      covered += estimate.low_95 <= truth && truth <= estimate.high_95;
    } else if (estimate.upper_bound) {
      ++bounds;
      bound += *estimate.upper_bound;
      covered += *estimate.upper_bound >= truth;
    }
  }
};

SelfTestRow row(const Truth& truth, const Sums& sums, const SignalAnalysis& signal, int runs) {
  SelfTestRow row{.sensor = signal.sensor,
                  .term = std::string(name_of(truth.term)),
                  .unit = unit_of(truth.term, signal.unit),
                  .truth = truth.value,
                  .runs = runs,
                  .resolved = sums.resolved};
  if (sums.resolved > 0) {
    row.mean = sums.value / sums.resolved;
    row.standard_deviation = std::sqrt(std::max(0.0, sums.square / sums.resolved - row.mean * row.mean));
  }
  if (sums.bounds > 0) row.bound = sums.bound / sums.bounds;
  row.covered = static_cast<double>(sums.covered) / runs;
  return row;
}

}  // namespace

SelfTest self_test(const ImuNoise& noise, double rate_hz, double duration_s, int runs, std::uint64_t seed,
                   const AllanOptions& options) {
  const Truth truths[] = {{0, Term::kWhite, noise.gyro.white},
                          {0, Term::kRandomWalk, noise.gyro.walk},
                          {0, Term::kFlicker, noise.gyro.bias_instability},
                          {1, Term::kWhite, noise.accel.white},
                          {1, Term::kRandomWalk, noise.accel.walk},
                          {1, Term::kFlicker, noise.accel.bias_instability}};
  SelfTest test{.rate_hz = rate_hz, .duration_s = duration_s, .rows = {}};
  std::vector<Sums> sums(std::size(truths));
  AllanResult last;
  Progress progress("self-test", static_cast<std::uint64_t>(runs));
  for (int run = 0; run < runs; ++run) {
    last = analyze_simulated(noise, rate_hz, duration_s, seed + static_cast<std::uint64_t>(run), options);
    for (std::size_t i = 0; i < std::size(truths); ++i) {
      sums[i].add(last.signals[truths[i].signal].terms[truths[i].term], truths[i].value);
    }
    for (std::size_t s = 0; s < 2; ++s) {
      test.imu_utils_n[s] += last.signals[s].imu_utils.n / runs;
      test.imu_utils_w[s] += last.signals[s].imu_utils.w / runs;
    }
    progress.add(1);
  }
  for (std::size_t i = 0; i < std::size(truths); ++i) {
    if (truths[i].value > 0.0) test.rows.push_back(row(truths[i], sums[i], last.signals[truths[i].signal], runs));
  }
  return test;
}

std::string self_test_text(const SelfTest& test) {
  Table table({{"sensor", Table::Align::kLeft},
               {"term", Table::Align::kLeft},
               {"truth"},
               {"unit", Table::Align::kLeft},
               {"resolved"},
               {"mean"},
               {"scatter"},
               {"mean/truth"},
               {"inside 95 %"},
               {"bound of the others"}});
  for (const SelfTestRow& row : test.rows) {
    const bool found = row.resolved > 0;
    const std::optional<double> none;
    table.add_row({row.sensor, row.term, number_text(row.truth, 4), row.unit,
                   std::to_string(row.resolved) + "/" + std::to_string(row.runs),
                   found ? number_text(row.mean, 5) : "-", found ? number_text(row.standard_deviation, 2) : "-",
                   found ? number_text(row.mean / row.truth, 5) : "-", number_text(100.0 * row.covered, 3) + " %",
                   row.bound > 0.0 ? number_text(row.bound, 3) : "-"});
  }
  std::string text = "Simulated, identified and compared: " + number_text(test.duration_s, 6) + " s at " +
                     number_text(test.rate_hz, 6) + " Hz\n" + table.text();
  const char* names[] = {"gyr", "acc"};
  for (std::size_t s = 0; s < 2; ++s) {
    text += std::string("imu_utils would print ") + names[s] + "_n " + number_text(test.imu_utils_n[s], 4) + ", " +
            names[s] + "_w " + number_text(test.imu_utils_w[s], 4) + " (mean of the runs)\n";
  }
  return text;
}

std::string self_test_json(const SelfTest& test, const JsonContext& context) {
  JsonObject document = begin_document("vispline.allan-self-test/1", context);
  document.set("rate_hz", test.rate_hz).set("duration_s", test.duration_s);
  std::vector<JsonObject> rows;
  for (const SelfTestRow& row : test.rows) {
    JsonObject object;
    object.set("sensor", row.sensor).set("term", row.term).set("unit", row.unit).set("truth", row.truth);
    object.set("runs", row.runs).set("resolved", row.resolved);
    const std::optional<double> none;
    object.set("mean", row.resolved > 0 ? std::optional(row.mean) : none);
    object.set("standard_deviation", row.resolved > 0 ? std::optional(row.standard_deviation) : none);
    object.set("covered", row.covered).set("bound", row.bound > 0.0 ? std::optional(row.bound) : none);
    rows.push_back(object);
  }
  document.set("terms", rows);
  const char* sensors[] = {"gyroscope", "accelerometer"};
  JsonObject imu_utils;
  for (std::size_t s = 0; s < 2; ++s) {
    imu_utils.set(sensors[s], JsonObject().set("n", test.imu_utils_n[s]).set("w", test.imu_utils_w[s]));
  }
  document.set("imu_utils", imu_utils);
  end_document(document, context);
  return document.text();
}

}  // namespace vispline::cli
