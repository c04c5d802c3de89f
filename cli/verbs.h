/// The verbs of the program, one file each. add_*() declares the flags and what to run when the verb is chosen.
#pragma once

#include <CLI/CLI.hpp>

namespace vispline::cli {

void add_simulate(CLI::App& app);
void add_integrate(CLI::App& app);
void add_allan(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_export(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_estimate(CLI::App& app);
void add_info(CLI::App& app);
void add_convert(CLI::App& app);
void add_demo(CLI::App& app);

}  // namespace vispline::cli
