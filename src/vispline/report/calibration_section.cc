#include "vispline/report/calibration_section.h"

#include <algorithm>

#include "vispline/report/calibration_plots.h"
#include "vispline/report/calibration_tables.h"
#include "vispline/report/number.h"

namespace vispline::report {
namespace {

std::string meaning_of(ResultClass result_class) {
  switch (result_class) {
    case ResultClass::kConverged:
      return "The result can be used.";
    case ResultClass::kConvergedWeak:
      return "The result can be used, but for the numbers that are named below: the recording does not show them.";
    case ResultClass::kNotConverged:
      return "The solver did not reach an end. Nothing here is a calibration.";
    case ResultClass::kRankDeficient:
      return "Something is not measured at all, so that infinitely many calibrations fit as well. Nothing here is one.";
    case ResultClass::kInconsistent:
      return "The residuals contradict the assumed noise or the model. Nothing here is a calibration.";
    case ResultClass::kFailed:
      return "The solver failed. Nothing here is a calibration.";
    case ResultClass::kStopped:
      return "The solver was stopped. What stands here is how far it had come.";
  }
  return "";
}

Cards cards_of(const CalibrationResult& result) {
  Cards cards;
  for (const SensorResiduals& r : result.residuals) {
    if (!r.px.empty()) cards.cards.push_back({r.rms, r.unit, joined({"residual of ", r.sensor, ", rms"}), 3});
  }
  if (result.trajectory) {
    cards.cards.push_back({1e3 * result.trajectory->position_m.rmse, "mm", "trajectory against the truth, rms", 3});
    cards.cards.push_back({result.trajectory->rotation_rmse_deg, "deg", "attitude against the truth, rms", 3});
  }
  if (result.twin) cards.cards.push_back({result.twin->nees, "", "NEES of the twin; 1 if sigmas are right", 3});
  double cpu_s = 0.0;
  for (const auto& [stage, seconds] : result.cpu_s) cpu_s += seconds;
  if (cpu_s > 0.0) cards.cards.push_back({cpu_s, "s", "processor time", 3});
  return cards;
}

Section class_section(const CalibrationResult& result) {
  Section section{joined({"Class: ", to_name(result.result_class)}), {Paragraph{meaning_of(result.result_class)}}};
  for (const std::string& reason : result.reasons) section.blocks.emplace_back(Paragraph{joined({"• ", reason, "."})});
  Cards cards = cards_of(result);
  if (!cards.cards.empty()) section.blocks.emplace_back(std::move(cards));
  return section;
}

Section parameter_section(const CalibrationResult& result) {
  Section section{"Parameters", {parameter_table(result)}};
  if (!result.fixed.empty()) {
    std::string names;
    for (const std::string& name : result.fixed) names += joined({names.empty() ? "" : ", ", name});
    section.blocks.emplace_back(Paragraph{joined({"Held at their start values: ", names, "."})});
  }
  if (!result.held.empty()) section.blocks.emplace_back(held_table(result));
  section.blocks.emplace_back(Paragraph{
      "A rotation is printed as its rotation vector; its sigmas are about the axes of the frame at the right of its "
      "name, and its error is the rotation that is left, not a difference of vectors."});
  return section;
}

Section weak_section(const CalibrationResult& result) {
  if (result.weak.empty()) {
    return {
        "What to record next",
        {Paragraph{"Every estimated number is known better than its limit: for these parameters the motion was rich "
                   "enough. A second recording that gives the same numbers within their sigmas would confirm them."}}};
  }
  return {"What to record next",
          {Paragraph{"Directions of the parameters that this recording leaves open, with one sigma along them, and the "
                     "motion that would show them."},
           weak_table(result)}};
}

Section confidence_section(const CalibrationResult& result) {
  Section section{"How far to trust the sigmas", {}};
  section.blocks.emplace_back(Paragraph{joined(
      {"Asked by differences, the cost is lowest within ", significant(result.gradient_sigmas, 2),
       " sigma of every parameter, and half a sigma away it rises ", significant(result.curvature_low, 3), " to ",
       significant(result.curvature_high, 3),
       " times as much as the sigmas say. Condition of the correlations: ", significant(result.condition, 2), "."})});
  if (result.twin) {
    section.blocks.emplace_back(Paragraph{joined(
        {"The twin (the estimate simulated and estimated again, ", std::to_string(result.twin->runs),
         " times) has a mean NEES of ", significant(result.twin->nees, 3), "; right sigmas give ",
         significant(result.twin->nees_low, 3), " to ", significant(result.twin->nees_high, 3),
         ". Its 95 % intervals hold ", significant(100.0 * result.twin->coverage, 3), " % of the true numbers."})});
  }
  if (result.jackknife) {
    section.blocks.emplace_back(Paragraph{
        joined({"The jack-knife asks how far each of ", std::to_string(result.jackknife->blocks),
                " blocks of time pulls the estimate. It needs no model of the noise: where it finds much more "
                "than sigma, noise is not white or the model lacks something."})});
  }
  if (result.twin || result.jackknife) section.blocks.emplace_back(spread_table(result));
  if (result.correlation.size() > 0) section.blocks.emplace_back(correlation_map(result));
  return section;
}

Section residual_section(const CalibrationResult& result) {
  Section section{"Residuals", {residual_table(result)}};
  for (const SensorResiduals& r : result.residuals) {
    if (r.count == 0) continue;
    section.blocks.emplace_back(Figure{{residual_plot(r)}, ""});
    if (r.px.empty()) continue;
    section.blocks.emplace_back(
        Figure{{reprojection_plot(r), region_plot(r)},
               "Left: residuals, with circles of one and three sigma. Right: their means by region of the image; a "
               "pattern means that the lens model does not fit."});
  }
  return section;
}

Section motion_section(const CalibrationResult& result, const CalibrationCourse& course) {
  Section section{"Motion", {Figure{course_plots(course), "Position of the body in the world."}}};
  if (auto error = course_error_plot(course)) section.blocks.emplace_back(Figure{{std::move(*error)}, ""});
  const KnotSpacing& knots = result.knots;
  if (knots.spacing_s > 0.0) {
    section.blocks.emplace_back(
        Paragraph{joined({"The curve is a ", knots.kind, " spline of order ", std::to_string(knots.order),
                          " with knots every ", significant(1e3 * knots.spacing_s, 3), " ms: ", knots.why, "."})});
  }
  return section;
}

Section diagnostic_section(const CalibrationResult& result) {
  Section section{"Warnings", {}};
  for (const Diagnostic& d : result.diagnostics.examples()) {
    std::string text = joined({d.code, ": ", d.message, "."});
    if (!d.effect.empty()) text += joined({" Effect: ", d.effect, "."});
    if (!d.next.empty()) text += joined({" Next: ", d.next, "."});
    section.blocks.emplace_back(Paragraph{std::move(text)});
  }
  return section;
}

}  // namespace

std::vector<Section> calibration_sections(const CalibrationResult& result, const CalibrationCourse& course) {
  std::vector<Section> sections{class_section(result)};
  if (!result.parameters.empty()) sections.push_back(parameter_section(result));
  sections.push_back(weak_section(result));
  if (result.correlation.size() > 0) sections.push_back(confidence_section(result));
  if (!result.residuals.empty()) sections.push_back(residual_section(result));
  if (course.T_w_b.size() > 1) sections.push_back(motion_section(result, course));
  if (!result.stages.empty()) sections.push_back({"How the start was found", {stage_table(result)}});
  if (!result.diagnostics.empty()) sections.push_back(diagnostic_section(result));
  return sections;
}

std::string calibration_page(const CalibrationResult& result, const CalibrationCourse& course, const std::string& title,
                             const Provenance& provenance) {
  return render({title, joined({"Calibration, class ", to_name(result.result_class)}),
                 calibration_sections(result, course), provenance});
}

}  // namespace vispline::report
