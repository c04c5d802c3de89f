#include "vispline/report/allan_section.h"

#include <algorithm>

#include "vispline/report/allan_plots.h"
#include "vispline/report/allan_tables.h"
#include "vispline/report/number.h"
#include "vispline/results/allan_documents.h"
#include "vispline/results/allan_words.h"

namespace vispline::report {
namespace {

constexpr int kDigits = 3;

std::string capitalized(std::string word) {
  if (!word.empty() && word[0] >= 'a' && word[0] <= 'z') word[0] = static_cast<char>(word[0] - 'a' + 'A');
  return word;
}

Cards cards_of(const std::vector<SensorSummary>& sensors) {
  Cards cards;
  for (const SensorSummary& sensor : sensors) {
    for (const Term term : {Term::kWhite, Term::kRandomWalk}) {
      const TermSummary& summary = sensor[term];
      if (!summary.mean) continue;
      std::string label = joined({pretty_unit(unit_of(term, sensor.unit)), ", ", sensor.sensor, ", ", words_of(term)});
      if (sensor.signals.size() > 1) label += ", mean of";
      for (const std::string& axis : summary.resolved_axes) label += " " + axis;
      cards.cards.push_back({*summary.mean, "", label, kDigits});
    }
  }
  return cards;
}

Section summary_section(const AllanResult& result, const std::vector<SensorSummary>& sensors) {
  const std::string record =
      joined({"A record of ", duration_text(result.duration_s), " at ", plain_number(result.rate_hz),
              " Hz: ", std::to_string(result.samples), " samples in ", std::to_string(result.segments),
              result.segments == 1 ? " segment" : " segments", " without gaps."});
  Section section{"In short", {Paragraph{record}}};
  const Cards cards = cards_of(sensors);
  if (!cards.cards.empty()) section.blocks.emplace_back(cards);
  section.blocks.emplace_back(Paragraph{
      "N is what averaging removes: the spread of a mean over τ seconds falls as N/√τ, and one sample at rate f "
      "spreads "
      "by N √f. K is how the bias wanders: after t seconds it has moved by K √t. B is the floor between the two, where "
      "longer averaging no longer helps; the curve lies at 0.664 B there."});
  return section;
}

std::string misfit_text(const SignalAnalysis& signal, const ModelMisfit& misfit) {
  return joined({capitalized(signal.sensor), " ", signal.axis, ": from ", plain_number(misfit.low_hz), " to ",
                 plain_number(misfit.high_hz), " Hz the measured power is ", significant(misfit.ratio, 2),
                 " times that of the terms; the fit gives these frequencies less weight."});
}

void add_figures(Section& section, const SignalAnalysis& signal) {
  const AllanCurve* curve = fitted_curve(signal);
  if (curve == nullptr) return;
  Figure figure{{terms_plot(signal)}, ""};
  if (signal.terms.deviation(curve->tau_s.front()) > 0.0) figure.plots.push_back(residual_plot(signal));
  for (Plot& plot : figure.plots) plot.width_px = 390.0;
  section.blocks.emplace_back(figure);
}

void add_curves(Section& section, const AllanResult& result, const SensorSummary& sensor) {
  std::vector<Deviation> kinds;
  for (const std::size_t i : sensor.signals) {
    for (const AllanCurve& curve : result.signals[i].curves) {
      if (std::find(kinds.begin(), kinds.end(), curve.deviation) != kinds.end()) continue;
      kinds.push_back(curve.deviation);
      section.blocks.emplace_back(Figure{{curves_plot(result, sensor, curve.deviation)},
                                         "Shaded: 68 % intervals. They widen to the right, where few averages are "
                                         "left to compare."});
    }
  }
}

Section sensor_section(const AllanResult& result, const SensorSummary& sensor) {
  Section section{capitalized(sensor.sensor), {}};
  add_curves(section, result, sensor);
  section.blocks.emplace_back(terms_table(result, sensor));
  section.blocks.emplace_back(quantities_table(result, sensor));
  for (const Term term : unresolved_terms(result, sensor)) {
    section.blocks.emplace_back(Paragraph{pretty_unit(unresolved_text(sensor, term)) + "."});
  }
  section.blocks.emplace_back(
      Paragraph{"Axis by axis: the measured curve, the resolved terms as grey lines with their slopes, and all terms "
                "together. Beside it, what the terms leave over; a curve inside its band is explained."});
  for (const std::size_t i : sensor.signals) {
    const SignalAnalysis& signal = result.signals[i];
    if (!signal.constant) add_figures(section, signal);
    for (const ModelMisfit& misfit : signal.misfits)
      section.blocks.emplace_back(Paragraph{misfit_text(signal, misfit)});
  }
  return section;
}

Section copy_section(const AllanResult& result) {
  Section section{"To copy", {}};
  const std::string yaml = allan_kalibr_yaml(result);
  if (!yaml.empty()) {
    section.blocks.emplace_back(Paragraph{
        "For the imu.yaml of Kalibr, continuous-time, the worst axis of each sensor; add rostopic. In practice the "
        "values are often enlarged several times, because a still sensor shows neither vibration nor temperature."});
    section.blocks.emplace_back(Preformatted{yaml});
  }
  section.blocks.emplace_back(Paragraph{
      "For a spreadsheet, separated by tabs, with 95 % intervals and bounds, in the units of the tables above:"});
  section.blocks.emplace_back(Preformatted{tsv_text(result)});
  return section;
}

Section checks_section(const AllanResult& result) {
  Section section{"Checks of the record", {}};
  if (result.diagnostics.empty()) {
    section.blocks.emplace_back(Paragraph{
        "No motion, drift, spikes, gaps, coarse steps or held samples were found, and the record is long enough."});
    return section;
  }
  Table table;
  table.columns = {{.header = "found", .unit = "", .numeric = false},
                   {.header = "what", .unit = "", .numeric = false},
                   {.header = "effect", .unit = "", .numeric = false},
                   {.header = "next step", .unit = "", .numeric = false}};
  for (const Diagnostic& d : result.diagnostics.examples()) table.rows.push_back({d.code, d.message, d.effect, d.next});
  section.blocks.emplace_back(table);
  for (const auto& [code, count] : result.diagnostics.counts()) {
    constexpr std::int64_t kShown = 3;
    if (count <= kShown) continue;
    section.blocks.emplace_back(Paragraph{joined({code, " occurred ", std::to_string(count), " times in all."})});
  }
  return section;
}

void add_imu_utils(std::vector<Section>& sections, const AllanResult& result,
                   const std::vector<SensorSummary>& sensors) {
  const Table table = imu_utils_table(sensors, result.rate_hz);
  Figure figure{{}, "The first axis of each sensor. The marks are the two numbers that imu_utils prints."};
  for (const SensorSummary& sensor : sensors) {
    for (const std::size_t i : sensor.signals) {
      if (result.signals[i].imu_utils.tau_s.empty()) continue;
      figure.plots.push_back(imu_utils_plot(result.signals[i], result.rate_hz));
      break;
    }
  }
  if (table.rows.empty()) return;
  Section section{"What imu_utils would print", {table}};
  if (!figure.plots.empty()) section.blocks.emplace_back(figure);
  section.blocks.emplace_back(Paragraph{
      joined({"gyr_n and acc_n are the standard deviation of one sample, N √rate; divide them by √",
              plain_number(result.rate_hz),
              " to have a density. gyr_w and acc_w are the lowest point of the fitted "
              "curve. With white noise and random walk alone that is √(2NK/√3), reached at τ = √3 N/K: it has the unit "
              "of a rate, not of a random walk, and says as much of N as of K. Pasted into Kalibr as a random walk it "
              "is wrong by a factor that depends on the sensor."})});
  sections.push_back(section);
}

}  // namespace

std::vector<Section> allan_sections(const AllanResult& result) {
  const std::vector<SensorSummary> sensors = summarize(result);
  std::vector<Section> sections{summary_section(result, sensors)};
  for (const SensorSummary& sensor : sensors) sections.push_back(sensor_section(result, sensor));
  sections.push_back(copy_section(result));
  sections.push_back(checks_section(result));
  add_imu_utils(sections, result, sensors);
  return sections;
}

std::string allan_page(const AllanResult& result, const std::string& title, const Provenance& provenance) {
  Page page;
  page.title = title;
  page.subtitle = "Noise of a still sensor: what averaging removes, what it does not, and how well either is known";
  page.sections = allan_sections(result);
  page.provenance = provenance;
  return render(page);
}

}  // namespace vispline::report
